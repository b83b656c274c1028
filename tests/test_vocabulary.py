"""Names and sentences in terms of the field: lists of words that were in use here and are not."""

import ast
import re
import tokenize
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import trundle

SOURCE = Path(trundle.__file__).parent
CPP = SOURCE.parents[1] / "cpp"

MODULES = {
    "beat", "between", "doors", "doubts", "errands", "exposure", "feeling", "grip", "lowest", "makers", "nearby",
    "noted", "notices", "outcome", "outgoing", "posted_calls", "postmortem", "pushes", "shelf", "showing", "sight",
    "stage", "surroundings", "told_time", "touching", "typed", "unremarkable", "unseen", "wrapped",
}  # fmt: skip
CLASSES = {
    "Beat", "Between", "Errands", "Feeling", "Grip", "Hold", "Instant", "Looker", "Makers", "Misfit", "Noted",
    "Notices", "Outcome", "Outgoing", "Patience", "Puppet", "Pushes", "Runaway", "Scenery", "Shelf", "Showing",
    "Sight", "Site", "Spot", "Stage", "Surroundings", "ToldTime", "Touch", "Touching",
}  # fmt: skip
CPP_TYPES = {
    "Around", "Bundle", "Coarse", "Fan", "Frame", "LetGo", "Look", "Meeting", "Pipe", "Raised", "Room", "Shot", "Sight",
    "Solid", "Waiting",
}  # fmt: skip
VERBS = {"attend", "feel", "gather", "give", "heed", "hear", "lay", "look", "obey", "strike", "take", "tell", "told"}
"""First words of functions; a sensor's verb is `measure`, a topic's `publish`."""

TERMS = {"give_up", "look_ahead", "look_up"}
"""Terms that begin with such a word."""


@cache
def _nodes(file: Path) -> list[ast.AST]:
    return list(ast.walk(ast.parse(file.read_text())))


def _sources() -> Iterator[Path]:
    return iter(sorted(SOURCE.rglob("*.py")))


def _definitions(kinds: tuple[type[ast.AST], ...]) -> Iterator[tuple[str, str]]:
    """Place and name of each definition, without leading underscores."""
    for file in _sources():
        for node in _nodes(file):
            if isinstance(node, kinds):
                name: str = node.name
                yield f"{file.relative_to(SOURCE)}:{node.lineno}", name.lstrip("_")


def test_modules_are_named_by_the_field() -> None:
    assert [file for file in _sources() if file.stem in MODULES] == []


def test_classes_are_named_by_the_field() -> None:
    assert [(where, name) for where, name in _definitions((ast.ClassDef,)) if name in CLASSES] == []


def test_functions_begin_with_verbs_of_the_field() -> None:
    found = _definitions((ast.FunctionDef, ast.AsyncFunctionDef))

    assert [(where, name) for where, name in found if name.split("_")[0] in VERBS and name not in TERMS] == []


def test_types_in_cpp_are_named_by_the_field() -> None:
    sources = [file for file in sorted(CPP.glob("*/*")) if file.suffix in (".cc", ".h")]
    types = [
        (file.name, name)
        for file in sources
        for name in re.findall(r"\b(?:struct|class|using|typename) (\w+)", file.read_text())
    ]

    assert [(where, name) for where, name in types if name in CPP_TYPES or len(name) == 1] == []


FIRST_WORDS = {
    "how", "it", "its", "likewise", "of", "such", "that", "there", "these", "this", "those", "what", "whatever", "when",
    "where", "whether", "who", "whoever", "whom", "whose", "why",
}  # fmt: skip
"""Words that begin a riddle; a docstring begins with a noun or verb of the field, after its shape or unit if any."""

RIDDLES = re.compile(
    r"\b((any|every|no|some)body|who(m|so)?ever|anew|tells|told|likewise|hence|whence|hither|thither|lest|n[ao]ught)\b"
    r"|\b(thereof|therein|whereof|forthwith|as they should be|as it were|is said|are said|in (its|their) stead)\b",
    re.IGNORECASE,
)
"""Words of tales, in docstrings, comments and messages."""


def _docstrings() -> Iterator[tuple[str, str]]:
    """Place and text of each docstring, those of attributes included."""
    for file in _sources():
        for node in _nodes(file):
            for statement in getattr(node, "body", []) if not isinstance(node, ast.Lambda | ast.IfExp) else []:
                match statement:
                    case ast.Expr(value=ast.Constant(value=str(text))):
                        yield f"{file.relative_to(SOURCE)}:{statement.lineno}", text
                    case _:
                        pass


def _comments_and_strings() -> Iterator[tuple[str, str]]:
    """Place and text of each comment and string, whose parts are tokens of their own in an f-string from 3.12 on."""
    kinds = (tokenize.COMMENT, tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING))
    for file in _sources():
        with file.open("rb") as stream:
            for token in tokenize.tokenize(stream.readline):
                if token.type in kinds:
                    yield f"{file.relative_to(SOURCE)}:{token.start[0]}", token.string


def _first_word(text: str) -> str:
    words = re.findall(r"[\w'-]+", re.sub(r"^\s*([(\[][^)\]]*[)\]]\s*)*", "", text))
    return words[0].lower() if words else ""


def test_docstrings_begin_with_nouns_or_verbs_of_the_field() -> None:
    assert [(where, text[:60]) for where, text in _docstrings() if _first_word(text) in FIRST_WORDS] == []


def test_docstrings_comments_and_messages_say_the_thing_itself() -> None:
    found = [(where, RIDDLES.search(text)) for where, text in _comments_and_strings()]

    assert [(where, word[0]) for where, word in found if word is not None] == []
