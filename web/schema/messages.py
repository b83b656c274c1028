"""Messages that cross between the page's server and its client: msgspec structs, and what is asked about them."""

from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias, get_args

from msgspec import NODEFAULT, Struct, inspect as types

from trundle.page.bag.lanes import Lanes
from trundle.page.clients.protocol import ClientOperation, SharedSelection
from trundle.page.clients.server_messages import ServerOperation
from trundle.page.replay.page_file import ReplayAbout
from trundle.page.requests.request import RenderView, SocketAction
from trundle.page.requests.world import RenderModel
from trundle.page.session import PageSession
from trundle.page.uploads.recording import UploadedRecording
from trundle.page.uploads.upload_folder import UploadedModels
from trundle.page.world import streams
from trundle.page.world.manifest import Manifest
from trundle.page.world.people import People
from trundle.page.world.profile import Profile
from trundle.page.world.reference import Differences, ReferenceInfo

REQUESTS: tuple[type[Struct], ...] = get_args(SocketAction)
QUERIES = (RenderView, RenderModel)
"""Requests that are addresses of pictures."""
CHANNELS: Mapping[str, Any] = {
    streams.SESSION: PageSession,
    streams.WORLD: Manifest,
    streams.STATE: streams.ClockState,
    streams.PERFORMANCE: Profile,
    streams.DIFFERENCES: Differences,
    streams.REFERENCE: ReferenceInfo | None,
    streams.DROPS: dict[str, int],
    streams.PEOPLE: People,
    streams.LANES: Lanes,
}
"""Content of the channels whose encoding is JSON."""
DOCUMENTS = (streams.SeriesHead, UploadedModels, UploadedRecording, ReplayAbout)
"""What else clients receive."""
UNIONS: Mapping[str, Any] = {
    "ServerOperation": ServerOperation,
    "ClientOperation": ClientOperation,
    "SharedSelection": SharedSelection,
}
"""Types that are one of several structs."""
Structs: TypeAlias = dict[type[Struct], types.StructType]


def structs_in(messages: Iterable[Any]) -> Structs:
    """Return the structs among these types and in them, the outer ones first."""
    found: Structs = {}

    def walk(kind: types.Type) -> None:
        match kind:
            case types.StructType(cls=cls):
                if cls not in found:
                    found[cls] = kind
                    for field in kind.fields:
                        walk(field.type)
            case types.UnionType(types=parts) | types.TupleType(item_types=parts):
                for part in parts:
                    walk(part)
            case types.ListType(item_type=part) | types.VarTupleType(item_type=part) | types.DictType(value_type=part):
                walk(part)
            case _:
                pass

    for message in messages:
        walk(types.type_info(message))
    return found


def answers_to(request: type[Struct]) -> tuple[type[Struct], ...]:
    """Return the types of a request's answers."""
    return get_args(request.answer) or (request.answer,)


SENT = structs_in([*REQUESTS, *QUERIES, ClientOperation])
RECEIVED = structs_in([ServerOperation, *CHANNELS.values(), *DOCUMENTS])
RECEIVED |= structs_in(answer for request in REQUESTS for answer in answers_to(request))


def is_optional(cls: type[Struct], field: types.Field) -> bool:
    """True if a field may be left out: of a request one with a default, of an answer one that can be unset."""
    if field.required:
        return False
    is_unset = field.default is NODEFAULT and field.default_factory is NODEFAULT
    return cls not in RECEIVED or is_unset or cls.__struct_config__.omit_defaults
