"""Action server that runs a state machine."""

import copy
import traceback
from collections.abc import Mapping, Sequence
from typing import Any

import rospy
import smach
from actionlib import SimpleActionServer


class ActionServerWrapper:
    """Starts a container for each goal; its outcome ends the goal."""

    def __init__(
        self,
        server_name: str,
        action_spec: type,
        wrapped_container: smach.Container,
        succeeded_outcomes: Sequence[str] = (),
        aborted_outcomes: Sequence[str] = (),
        preempted_outcomes: Sequence[str] = (),
        goal_key: str = "action_goal",
        feedback_key: str = "action_feedback",
        result_key: str = "action_result",
        goal_slots_map: Mapping[str, str] | None = None,
        feedback_slots_map: object = None,
        result_slots_map: Mapping[str, str] | None = None,
        expand_goal_slots: bool = False,
        pack_result_slots: bool = False,
    ) -> None:
        """Set the action.

        Args:
            server_name: action's name.
            action_spec: XAction class.
            wrapped_container: container to run.
            succeeded_outcomes: container's outcomes that are a success.
            aborted_outcomes: outcomes that are a failure, like all outcomes that are not listed.
            preempted_outcomes: outcomes of a preempted container.
            goal_key: goal's key in the userdata.
            feedback_key: feedback's key; the feedback is published at each transition.
            result_key: result's key.
            goal_slots_map: field of the goal → key.
            feedback_slots_map: no effect.
            result_slots_map: field of the result → key.
            expand_goal_slots: copy every field of the goal to a key of its name.
            pack_result_slots: copy every key that is a field of the result.
        """
        del feedback_slots_map
        self.wrapped_container = wrapped_container
        self.wrapped_container.register_transition_cb(self.transition_cb)
        self.wrapped_container.register_termination_cb(self.termination_cb)
        self._keys = (goal_key, feedback_key, result_key)
        self._goal_slots_map, self._result_slots_map = goal_slots_map or {}, result_slots_map or {}
        self._expand_goal_slots, self._pack_result_slots = expand_goal_slots, pack_result_slots
        self._server_name = server_name
        self._succeeded, self._preempted = set(succeeded_outcomes), set(preempted_outcomes)
        listed = [*succeeded_outcomes, *aborted_outcomes, *preempted_outcomes]
        if len(listed) != len(set(listed)):
            rospy.logerr(f"action {server_name}: an outcome is in more than one of succeeded, aborted and preempted")
        action = action_spec()
        self.userdata = smach.UserData()
        self.userdata[goal_key] = copy.copy(action.action_goal.goal)
        self.userdata[feedback_key] = copy.copy(action.action_feedback.feedback)
        self.userdata[result_key] = copy.copy(action.action_result.result)
        self._action_server = SimpleActionServer(server_name, action_spec, execute_cb=self.execute_cb, auto_start=False)

    def run_server(self) -> None:
        """Start the action server."""
        self._action_server.register_preempt_callback(self.preempt_cb)
        self._action_server.start()
        rospy.loginfo(f"Started SMACH action server wrapper, advertising as '{self._server_name}'")

    def transition_cb(self, userdata: Any, active_states: object) -> None:
        """Publish feedback."""
        self.publish_feedback(userdata)

    def termination_cb(self, userdata: Any, terminal_states: object, container_outcome: str) -> None:
        """Hook for subclasses, called at the container's end."""

    def publish_feedback(self, userdata: Any) -> None:
        """Publish the feedback in the userdata."""
        if self._keys[1] in userdata:
            self._action_server.publish_feedback(userdata[self._keys[1]])

    def execute_cb(self, goal: Any) -> None:
        """Run the container for a goal."""
        if self._expand_goal_slots:
            for slot in goal.__slots__:
                self.userdata[slot] = getattr(goal, slot)
        self.userdata[self._keys[0]] = goal
        for slot, key in self._goal_slots_map.items():
            self.userdata[key] = getattr(goal, slot)
        container = self.wrapped_container
        inputs, outputs = container.get_registered_input_keys(), container.get_registered_output_keys()
        try:
            outcome = container.execute(smach.Remapper(self.userdata, inputs, outputs))
        except Exception:
            rospy.logerr(f"Exception thrown while executing wrapped container: {traceback.format_exc()}")
            self._action_server.set_aborted()
            return
        result = self._result()
        if outcome in self._succeeded:
            self._action_server.set_succeeded(result)
        elif outcome in self._preempted:
            self._action_server.set_preempted(result)
        else:
            self._action_server.set_aborted(result)

    def _result(self) -> Any:
        result = self.userdata[self._keys[2]]
        for slot, key in self._result_slots_map.items():
            setattr(result, slot, self.userdata[key])
        if self._pack_result_slots:
            for slot in result.__slots__:
                if slot in self.userdata:
                    setattr(result, slot, self.userdata[slot])
        return result

    def preempt_cb(self) -> None:
        """Preempt the container."""
        rospy.loginfo("Preempt on state machine requested!")
        self.wrapped_container.request_preempt()
