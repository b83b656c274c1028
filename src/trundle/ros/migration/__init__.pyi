from .classes import MessageClass as MessageClass, MessageClasses as MessageClasses
from .generated import GeneratedRule as GeneratedRule, PlaceholderRule as PlaceholderRule
from .migrator import MigrationStep as MigrationStep, Migrator as Migrator, missing_rules as missing_rules
from .rule import MessageUpdateRule as MessageUpdateRule, MigrationError as MigrationError, Rule as Rule
from .rule_files import RuleFile as RuleFile
