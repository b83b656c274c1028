from .built_in import BUILT_IN as BUILT_IN
from .fetch import Fetcher as Fetcher, FetchResult as FetchResult, checkout_folder as checkout_folder
from .plan import FetchPlan as FetchPlan, plan_fetch as plan_fetch
