"""Message types of an action."""

from .exceptions import ActionException


class ActionTypes:
    """Types of the messages of one action, from its XAction class."""

    def __init__(self, action_spec: type) -> None:
        """Read the types from an XAction class.

        Raises:
            ActionException: the class is not an action.
        """
        try:
            action = action_spec()
            self.ActionSpec = action_spec
            self.ActionGoal = type(action.action_goal)
            self.ActionResult = type(action.action_result)
            self.ActionResultType = type(action.action_result.result)
            self.ActionFeedback = type(action.action_feedback)
        except (AttributeError, TypeError):
            raise ActionException(
                f"Type is not an action spec: {action_spec}; it should be named XAction and come from PACKAGE.msg"
            ) from None
