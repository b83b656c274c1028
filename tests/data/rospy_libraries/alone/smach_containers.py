"""smach: state machines, sequences, concurrences, iterators, userdata, preemption, errors."""

import threading

import smach
from smach import CBState, Concurrence, Iterator, Sequence, State, StateMachine


def quiet(_text):
    """Drop log lines."""


infos = []
smach.set_loggers(infos.append, quiet, quiet, quiet)


class Count(State):
    """Counts to three."""

    def __init__(self):
        State.__init__(self, outcomes=["again", "done"], input_keys=["n"], output_keys=["n"])

    def execute(self, userdata):
        """Add one."""
        userdata.n += 1
        return "again" if userdata.n < 3 else "done"


@smach.cb_interface(input_keys=["total"], output_keys=["text"], outcomes=["ok"])
def tell(userdata, word):
    """Write a text."""
    userdata.text = f"{word} {userdata.total}"
    return "ok"


sm = StateMachine(outcomes=["finished", "failed"], output_keys=["text"])
sm.userdata.total = 0
with sm:
    StateMachine.add("COUNT", Count(), transitions={"again": "COUNT", "done": "TELL"}, remapping={"n": "total"})
    StateMachine.add("TELL", CBState(tell, cb_args=["counted"]), {"ok": "finished"})
calls = []
sm.register_start_cb(lambda ud, initial, *args: calls.append(("start", initial, args)), ["extra"])
sm.register_transition_cb(lambda ud, active: calls.append(("transition", active)))
sm.register_termination_cb(lambda ud, terminal, outcome: calls.append(("end", terminal, outcome)))
print(sm.execute(), sm.userdata.text, sm.userdata.keys(), sm.is_running())
print(calls)
print(infos)
infos.clear()
print(sorted(sm.get_internal_edges()), sm.get_initial_states(), sm.get_active_states(), sorted(sm.get_children()))
print(sorted(sm.get_registered_outcomes()), sm["TELL"].get_registered_input_keys())

parent = StateMachine(["finished", "failed"])
parent.userdata.text = "none"
with parent:
    StateMachine.add("CHILD", sm)
    print(StateMachine._currently_opened_container() is parent, parent.is_opened())
print(parent.execute(), parent.userdata.text)

sequence = Sequence(outcomes=["ok", "bad"], connector_outcome="ok")
order = []
with sequence:
    for name in ("A", "B", "C"):
        Sequence.add(name, CBState(lambda ud, n: (order.append(n), "ok")[1], cb_args=[name], outcomes=["ok", "bad"]))
print(sequence.execute(), order, sorted(edge[:3] for edge in sequence.get_internal_edges() if edge[0] == "ok"))

auto = StateMachine(["ok"])
with auto:
    StateMachine.add_auto("ONE", CBState(lambda ud: "ok", outcomes=["ok"]), ["ok"])
    StateMachine.add_auto("TWO", CBState(lambda ud: "ok", outcomes=["ok"]), ["ok"])
    StateMachine.add("THREE", CBState(lambda ud: "ok", outcomes=["ok"]))
print(auto.execute(), auto.get_internal_edges())

iterator = Iterator(
    outcomes=["good", "bad"],
    input_keys=[],
    output_keys=["seen"],
    it=[1, 2, 3, 4],
    it_label="item",
    exhausted_outcome="good",
)
iterator.userdata.seen = []


def look(userdata):
    """Stop at the limit."""
    userdata.seen.append(userdata.item)
    return "stop" if userdata.item == LIMIT else "next"


with iterator:
    body = CBState(look, outcomes=["next", "stop"], input_keys=["item", "seen"], output_keys=["seen"])
    Iterator.set_contained_state("LOOK", body, loop_outcomes=["next"], final_outcome_map={"stop": "bad"})
LIMIT = 3
print(iterator.execute(), iterator.userdata.seen, iterator.get_internal_edges())
LIMIT, iterator.userdata.seen = 99, []
print(iterator.userdata.seen, iterator.get_children().keys() == {"LOOK"}, sorted(iterator.get_registered_outcomes()))


class Wait(State):
    """Waits for an event or a preempt."""

    def __init__(self, event):
        State.__init__(self, outcomes=["done", "preempted"])
        self.event = event

    def execute(self, userdata):
        """Wait."""
        for _ in range(3000):
            if self.preempt_requested():
                self.service_preempt()
                return "preempted"
            if self.event.wait(0.01):
                return "done"
        return "done"


go, never = threading.Event(), threading.Event()
go.set()
both = Concurrence(
    outcomes=["all", "some", "preempted"], default_outcome="some", outcome_map={"all": {"X": "done", "Y": "done"}}
)
with both:
    Concurrence.add("X", Wait(go))
    Concurrence.add("Y", Wait(go))
print(both.execute(), sorted(both.get_internal_edges()), both.get_active_states(), sorted(both.get_initial_states()))
race = Concurrence(["some", "x first"], "some", child_termination_cb=lambda outcomes: outcomes["X"] == "done",
                   outcome_cb=lambda outcomes: "x first" if outcomes == {"X": "done", "Y": "preempted"} else None)  # fmt: skip
with race:
    Concurrence.add("X", Wait(go))
    Concurrence.add("Y", Wait(never))
print(race.execute())
stuck = StateMachine(["done", "preempted"])
with stuck:
    inner = Concurrence(["done", "preempted"], "done")
    with inner:
        Concurrence.add("W", Wait(never))
        Concurrence.add("V", Wait(never))
    StateMachine.add("BOTH", inner)
threading.Timer(0.3, stuck.request_preempt).start()
print(stuck.execute(), stuck.preempt_requested(), inner.preempt_requested())

remapper = smach.Remapper(sm.userdata, ["n", "o"], ["n"], {"n": "total"})
sm.userdata.o = type("Thing", (), {"a": 1})()
print(remapper.n, "n" in remapper, "total" in remapper, remapper.o.a)
remapper.n = 5
print(sm.userdata.total, sm.userdata["total"])
remapper.other = 1
print("other" in sm.userdata)


def attempt(function):
    """Print the error's name."""
    try:
        print("no error", function())
    except Exception as error:
        print(type(error).__name__)


attempt(lambda: remapper.other)
attempt(lambda: sm.userdata.missing)
attempt(lambda: StateMachine.add("X", Count()))
attempt(lambda: sm["NOPE"])
attempt(lambda: State(["a"]).execute(None))
broken = StateMachine(["done"])
with broken:
    StateMachine.add("R", CBState(lambda ud: 1 / 0, outcomes=["done"]))
attempt(broken.execute)
wrong = StateMachine(["done"])
with wrong:
    StateMachine.add("R", CBState(lambda ud: "surprise", outcomes=["done"]))
attempt(wrong.execute)
dangling = StateMachine(["done"])
with dangling:
    StateMachine.add("R", CBState(lambda ud: "done", outcomes=["done"]), {"done": "NOWHERE"})
print(dangling.execute())
doubled = StateMachine(["done"])
doubled.open()
StateMachine.add("R", CBState(lambda ud: "done", outcomes=["done"]))
attempt(lambda: StateMachine.add("R", CBState(lambda ud: "done", outcomes=["done"])))
attempt(lambda: StateMachine.add("S", CBState(lambda ud: "done", outcomes=["done"]), {"nope": "R"}))
doubled.close()
attempt(lambda: Concurrence(["a"], "b"))
attempt(Concurrence(["a"], "a").execute)
with StateMachine(["x"]).opened() as empty:
    pass
print(empty.execute())
data = smach.UserData()
data.a, data["b"] = [1], 2
copied = data.extract(["a"], {"z": "a"})
copied.merge(data, ["b"], {"b": "bb"})
print(sorted(copied.keys()), copied.z == data.a, copied.z is data.a, "a" in data)
