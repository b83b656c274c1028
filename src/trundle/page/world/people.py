"""Channel of the users of the page: their numbers, selections and access."""

import itertools

import msgspec

from ..clients.channel import Channel, Client
from ..clients.protocol import SharedSelection
from .streams import PEOPLE

_PERIOD_S = 0.1


class Person(msgspec.Struct):
    """A client that subscribes to the channel."""

    number: int
    """Number from 1; numbers of users who have left are reused."""
    view_only: bool
    selection: SharedSelection | None = None


class People(msgspec.Struct):
    """Users of the page."""

    you: int
    """Number of the recipient."""
    people: tuple[Person, ...]


class PeopleChannel(Channel):
    """List of users, sent to each with the recipient's number, at subscription and after changes at up to 10 Hz."""

    def __init__(self) -> None:
        super().__init__(PEOPLE, encoding="json", trundle_only=True)
        self._people: dict[Client, Person] = {}
        self._has_changed = False
        self._due_s = 0.0

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        used = {person.number for person in self._people.values()}
        number = next(number for number in itertools.count(1) if number not in used)
        self._people[client] = Person(number, client.is_view_only)
        self._has_changed = True

    def unsubscribe(self, client: Client) -> None:
        super().unsubscribe(client)
        del self._people[client]
        self._has_changed = True

    def select(self, client: Client, selection: SharedSelection | None) -> None:
        """Set a user's selection."""
        if (person := self._people.get(client)) is not None:
            person.selection = selection
            self._has_changed = True

    def poll(self, now_s: float, time_ns: int) -> bool:
        """Send the list if it has changed and is due; return False, since the data are not the owner's."""
        if self._has_changed and now_s >= self._due_s:
            self._has_changed, self._due_s = False, now_s + _PERIOD_S
            people = tuple(sorted(self._people.values(), key=lambda person: person.number))
            for client, person in self._people.items():
                client.send_message(self, time_ns, (msgspec.json.encode(People(person.number, people)),))
        return False
