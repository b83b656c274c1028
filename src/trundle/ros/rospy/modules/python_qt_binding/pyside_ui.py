"""Loading of Qt Designer's files into an existing widget, which PySide6's own loader cannot do."""

from PySide6.QtCore import QMetaObject
from PySide6.QtUiTools import QUiLoader

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any


class UiLoader(QUiLoader):
    """Loader that uses an existing widget as the top-level one, with the other widgets as its attributes."""

    def __init__(self, base: "Any", custom_widgets: "Mapping[str, type]") -> None:
        """Register the custom widgets.

        Args:
            base: top-level widget; None: a new one.
            custom_widgets: class name → class.
        """
        super().__init__(base)
        self._base = base
        for widget_class in custom_widgets.values():
            self.registerCustomWidget(widget_class)

    def createWidget(self, className: str, parent: "Any" = None, name: str = "") -> "Any":
        """Create a widget of the file; the top-level one is the existing widget."""
        if parent is None and self._base is not None:
            return self._base
        widget = super().createWidget(className, parent, name)
        if self._base is not None and name:
            setattr(self._base, name, widget)
        return widget

    def load(self, uifile: object) -> "Any":
        """Load a file, and connect `on_NAME_SIGNAL` methods."""
        widget = super().load(str(uifile))
        QMetaObject.connectSlotsByName(widget)
        return widget
