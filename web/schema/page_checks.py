"""Checks of what the page's clients receive: a function of web/src/protocol/check.ts for each struct."""

import json
from collections.abc import Iterable

from msgspec import Struct, inspect as types

from messages import CHANNELS, RECEIVED, REQUESTS, answers_to, is_optional
from trundle.page.clients.server_messages import ServerOperation

HEAD = """/** Checks of the messages that the page receives, made by web/schema. */

import * as is from "../check";
import type * as page from "./page_messages";
"""
ANSWERS = 'export const answers: { readonly [N in keyof page.Requests]: is.Check<page.Requests[N]["answer"]> } = {'
CHANNEL_MAP = "export const channels: { readonly [T in keyof page.Channels]: is.Check<page.Channels[T]> } = {"


def check_text(kind: types.Type) -> str:
    """Return the check of a type, of those in check.ts."""
    match kind:
        case types.IntType():
            return "is.number"
        case types.FloatType():
            return "is.float"
        case types.StrType():
            return "is.text"
        case types.BoolType():
            return "is.flag"
        case types.LiteralType(values=values):
            return f"is.literal({', '.join(map(json.dumps, values))})"
        case types.UnionType(types=parts):
            others = [part for part in parts if not isinstance(part, types.NoneType)]
            text = check_text(others[0]) if len(others) == 1 else union_text(others)
            return text if len(others) == len(parts) else f"is.nullable({text})"
        case types.ListType(item_type=part) | types.VarTupleType(item_type=part):
            return f"is.list({check_text(part)})"
        case types.TupleType(item_types=parts):
            return f"is.tuple({', '.join(map(check_text, parts))})"
        case types.DictType(value_type=part):
            return f"is.record({check_text(part)})"
        case types.StructType(cls=cls):
            return check_name(cls)
        case _:
            return "is.json"


def union_text(parts: Iterable[types.Type]) -> str:
    """Return the check of a union: of structs with a tag by that, of others one after the other."""
    tags = {part.tag: check_text(part) for part in parts if isinstance(part, types.StructType) and part.tag_field}
    if not tags:
        return f"is.oneOf({', '.join(map(check_text, parts))})"
    (field,) = {part.tag_field for part in parts}
    checks = ", ".join(f"{json.dumps(tag)}: {text}" for tag, text in tags.items())
    return f"is.tagged({json.dumps(field)}, () => ({{ {checks} }}))"


def check_name(cls: type[Struct]) -> str:
    """Return the name of a struct's check."""
    return cls.__name__[0].lower() + cls.__name__[1:]


def page_checks() -> str:
    """Return the checks of what clients receive."""
    lines = [HEAD]
    for cls, kind in RECEIVED.items():
        fields = [f"{kind.tag_field}: is.literal({json.dumps(kind.tag)})"] if kind.tag_field else []
        for each in kind.fields:
            text = check_text(each.type)
            fields.append(f"{each.encode_name}: {f'is.optional({text})' if is_optional(cls, each) else text}")
        of = f"is.Check<page.{cls.__name__}>"
        lines += [f"export const {check_name(cls)}: {of} = is.struct(() => ({{ {', '.join(fields)} }}));", ""]
    operation = check_text(types.type_info(ServerOperation))
    lines += [f"export const serverOperation: is.Check<page.ServerOperation> = {operation};", ""]
    lines.append(ANSWERS)
    for request in REQUESTS:
        checks = [check_name(each) for each in answers_to(request)]
        tag = request.__struct_config__.tag
        lines.append(f"  {tag}: {checks[0] if len(checks) == 1 else 'is.oneOf(' + ', '.join(checks) + ')'},")
    lines += ["};", "", CHANNEL_MAP]
    lines += [f'  "{topic}": {check_text(types.type_info(content))},' for topic, content in CHANNELS.items()]
    return "\n".join([*lines, "};", ""])
