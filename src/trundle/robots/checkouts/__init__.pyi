from .built_in import BUILT_IN as BUILT_IN
from .fetch import Fetcher as Fetcher
from .fetch import FetchResult as FetchResult
from .fetch import checkout_folder as checkout_folder
from .plan import FetchPlan as FetchPlan
from .plan import plan_fetch as plan_fetch
