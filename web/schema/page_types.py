"""TypeScript types of the page's messages, with the docstrings of the structs as comments."""

import ast
import inspect
import json
import re
import textwrap
from itertools import pairwise

from msgspec import Struct, inspect as types

from messages import CHANNELS, RECEIVED, REQUESTS, SENT, UNIONS, answers_to, is_optional

HEAD = """/** Messages between the page's server and its client, made by web/schema. */

import type { Json } from "../json";
"""


def type_text(kind: types.Type) -> str:
    """Return a type in TypeScript."""
    match kind:
        case types.IntType() | types.FloatType():
            return "number"
        case types.StrType():
            return "string"
        case types.BoolType():
            return "boolean"
        case types.NoneType():
            return "null"
        case types.LiteralType(values=values):
            return " | ".join(map(json.dumps, values))
        case types.UnionType(types=parts):
            return " | ".join(map(type_text, sorted(parts, key=lambda part: isinstance(part, types.NoneType))))
        case types.ListType(item_type=part) | types.VarTupleType(item_type=part):
            text = type_text(part)
            return f"readonly ({text})[]" if " " in text else f"readonly {text}[]"
        case types.TupleType(item_types=parts):
            return f"readonly [{', '.join(map(type_text, parts))}]"
        case types.DictType(value_type=part):
            return f"{{ readonly [name: string]: {type_text(part)} }}"
        case types.StructType(cls=cls):
            return cls.__name__
        case types.CustomType(cls=cls) if cls is object:
            return "Json"
        case _:
            raise NotImplementedError(f"{kind} in a message")


def comment(text: str | None) -> list[str]:
    """Return a docstring as a comment."""
    if not text:
        return []
    text = re.sub(r"(^|\. )None\b", r"\1Null", text)
    for python, script in (("None", "null"), ("True", "true"), ("False", "false")):
        text = re.sub(rf"\b{python}\b", script, text)
    lines = text.strip().splitlines()
    return [f"/** {lines[0]} */"] if len(lines) == 1 else ["/**", *(f" * {line}".rstrip() for line in lines), " */"]


def field_docs(cls: type[Struct]) -> dict[str, str]:
    """Return the docstrings of a struct's fields, which stand below them in the source."""
    docs: dict[str, str] = {}
    for each in cls.__mro__:
        if each is Struct or not issubclass(each, Struct):
            continue
        (tree,) = ast.parse(textwrap.dedent(inspect.getsource(each))).body
        assert isinstance(tree, ast.ClassDef)
        for field, below in pairwise(tree.body):
            match field, below:
                case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(value=ast.Constant(value=str(text))):
                    docs[name] = inspect.cleandoc(text)
                case _:
                    pass
    return docs


def interface(kind: types.StructType) -> list[str]:
    """Return a struct as an interface; the name of a request is not a part of it."""
    cls, docs = kind.cls, field_docs(kind.cls)
    fields = [] if kind.tag_field in (None, "request") else [f"  readonly {kind.tag_field}: {json.dumps(kind.tag)};"]
    for field in kind.fields:
        mark = "?" if is_optional(cls, field) else ""
        lines = [*comment(docs.get(field.name)), f"readonly {field.encode_name}{mark}: {type_text(field.type)};"]
        fields += [f"  {line}" for line in lines]
    head = comment(inspect.getdoc(cls))
    if not fields:
        return [*head, f"export type {cls.__name__} = {{ readonly [name: string]: never }};", ""]
    return [*head, f"export interface {cls.__name__} {{", *fields, "}", ""]


def page_messages() -> str:
    """Return the types of the page's messages."""
    lines = [HEAD, *(line for kind in (RECEIVED | SENT).values() for line in interface(kind))]
    for name, union in UNIONS.items():
        lines += [f"export type {name} = {type_text(types.type_info(union))};", ""]
    lines += ["/** Requests, and their answers. */", "export interface Requests {"]
    for request in REQUESTS:
        answer = " | ".join(each.__name__ for each in answers_to(request))
        tag = request.__struct_config__.tag
        lines.append(f"  readonly {tag}: {{ readonly fields: {request.__name__}; readonly answer: {answer} }};")
    lines += ["}", "", "/** Content of channels whose encoding is JSON. */", "export interface Channels {"]
    for topic, content in CHANNELS.items():
        lines.append(f'  readonly "{topic}": {type_text(types.type_info(content))};')
    return "\n".join([*lines, "}", ""])
