"""Services and waiting for them, where programs import them from."""

from ..service import Service as Service
from ..service import ServiceException as ServiceException
from ..service import ServiceImpl as ServiceImpl
from ..service import ServiceProxy as ServiceProxy
from ..service import convert_return_to_response as convert_return_to_response
from ..service_wait import wait_for_service as wait_for_service
