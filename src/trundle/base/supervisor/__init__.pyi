from .job import Job as Job, JobError as JobError, RespawnPolicy as RespawnPolicy, StopTimeouts as StopTimeouts
from .job_supervisor import Event as Event, EventKind as EventKind, Supervisor as Supervisor
from .process import ProcessCommand as ProcessCommand, ProcessJob as ProcessJob
from .process_tree import ProcessTree as ProcessTree
from .task import TaskJob as TaskJob
from .terminal import HAS_PSEUDO_TERMINALS as HAS_PSEUDO_TERMINALS, MAX_SIZE as MAX_SIZE, Terminal as Terminal
