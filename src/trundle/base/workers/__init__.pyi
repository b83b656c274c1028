from .engine import check_workers as check_workers
from .engine import run_job as run_job
from .engine import run_rows as run_rows
from .job import Failure as Failure
from .job import Job as Job
from .job import JobResult as JobResult
from .progress import Progress as Progress
