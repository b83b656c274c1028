"""Old messages brought up to the types of today, by rule files as rosbag has them."""

from .classes import MessageClass, MessageClasses
from .generated import GeneratedRule, HalfRule
from .migrator import Migrator, Step, missing_rules
from .rule import MessageUpdateRule, MigrationError, Rule
from .rule_files import RuleFile

__all__ = [
    "GeneratedRule",
    "HalfRule",
    "MessageClass",
    "MessageClasses",
    "MessageUpdateRule",
    "MigrationError",
    "Migrator",
    "Rule",
    "RuleFile",
    "Step",
    "missing_rules",
]
