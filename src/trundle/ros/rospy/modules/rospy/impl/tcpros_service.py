"""Services and waiting for them, at the path that programs import them from."""

from ..service import (
    Service as Service,
    ServiceException as ServiceException,
    ServiceImpl as ServiceImpl,
    ServiceProxy as ServiceProxy,
    convert_return_to_response as convert_return_to_response,
)
from ..service_wait import wait_for_service as wait_for_service
