"""Qt Designer's files into an existing widget, which PySide6's own loader does not do."""

from PySide6.QtCore import QMetaObject
from PySide6.QtUiTools import QUiLoader


class UiLoader(QUiLoader):
    """Loader that makes a given widget the top-level one, and the others its attributes."""

    def __init__(self, base, custom_widgets):
        """Prepare.

        Args:
            base: top-level widget; None: a new one.
            custom_widgets: class name → class.
        """
        super().__init__(base)
        self._base = base
        for each in custom_widgets.values():
            self.registerCustomWidget(each)

    def createWidget(self, className, parent=None, name=""):
        """Create a widget of the file; the first is the given one."""
        if parent is None and self._base is not None:
            return self._base
        widget = super().createWidget(className, parent, name)
        if self._base is not None and name:
            setattr(self._base, name, widget)
        return widget

    def load(self, uifile):
        """Load a file, and connect `on_NAME_SIGNAL` methods."""
        widget = super().load(str(uifile))
        QMetaObject.connectSlotsByName(widget)
        return widget
