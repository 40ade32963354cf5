# SPDX-License-Identifier: BSD-3-Clause
"""Clicks in the application, as ParaView's own player takes them."""
from xml.sax.saxutils import quoteattr

WINDOW = "pqClientMainWindow"
PANEL = "propertiesDock/propertiesPanel"
PROPERTIES = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel"
BROWSER = "pipelineBrowserDock/pipelineBrowser"
DIALOG = "SelectInputDialog"
VIEWS = "centralwidget/MultiViewWidget/CoreWidget/qt_tabwidget_stackedwidget/MultiViewWidget1/Container"


def event(widget, command, arguments=""):
    return f'<pqevent object="{WINDOW}/{widget}" command="{command}" arguments="{arguments}" />'


APPLY = event(f"{PANEL}/Accept", "activate")


def menu(name, entry):
    return event(f"menubar/{name}", "activate", entry)


def files(action, dialog, path):
    return [menu("menu_File", action), event(dialog, "filesSelected", path)]


def filter_of_menu(name):
    """ParaView 5.13 fills its menus when they open."""
    return [event("menubar", "activate", "menuFilters"), menu("menuFilters/PoseEstimation", name)]


def item(tree, *rows):
    """An entry of a tree, by its row in each level."""
    path = "/0:0" + "".join(f"/{row}:0" for row in rows)
    return [event(tree, f"mouse{what}", f"1,{buttons},0,60,9,{path}") for what, buttons in (("Press", 1), ("Release", 0))]


def connect(name, *rows):
    """An input in the dialog that asks for them."""
    return [event(f"{DIALOG}/buttonFrame/{name}", "set_boolean", "true"), *item(f"{DIALOG}/pipelineView", *rows)]


def accept_inputs():
    return event(f"{DIALOG}/buttonBox/1QPushButton0", "activate")


def choice(name, text):
    return event(f"{PROPERTIES}/{name}/ComboBox", "set_string", text)


def number(name, value):
    return event(f"{PROPERTIES}/{name}/DoubleLineEdit0", "set_string", str(value))


def view(cell):
    """The picture in a cell of the layout: 0 of all, 1 and 2 are its halves."""
    return f"{VIEWS}/Frame.{cell}/CentralWidgetFrame/Viewport"


def point_and_press(picture, x, y, key, control=False):
    """The mouse to a place in a picture, both from 0 to 1, and a letter."""
    press, modifiers = 6, 0x04000000 if control else 0  # as Qt has them
    return [event(picture, "mouseMove", f"({x},{y},0,0,0)"), event(picture, "keyEvent", f"{press}:{ord(key)}:{modifiers}::0:1")]


def expect(widget, name, value):
    return f'<pqcheck object="{WINDOW}/{widget}" property="{name}" arguments={quoteattr(value, {chr(10): "&#10;"})} />'
