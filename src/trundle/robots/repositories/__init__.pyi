from .address import https_address as https_address
from .distribution import (
    ListedRepository as ListedRepository,
    read_distribution as read_distribution,
    read_repository_list as read_repository_list,
    write_rosinstall as write_rosinstall,
)
from .entry import ROSDISTROS as ROSDISTROS, Entry as Entry, nearest_distros as nearest_distros
from .index import (
    Checkout as Checkout,
    Index as Index,
    repository_hint as repository_hint,
    shipped_index as shipped_index,
)
from .index_file import read_index as read_index
from .python_names import python_library as python_library
from .table import read_table as read_table, write_table as write_table
