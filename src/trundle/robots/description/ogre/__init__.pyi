from .find import find_material as find_material
