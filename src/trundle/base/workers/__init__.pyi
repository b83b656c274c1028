from .engine import check_workers as check_workers, run_job as run_job, run_rows as run_rows
from .job import Failure as Failure, Job as Job, JobResult as JobResult
from .progress import Progress as Progress
