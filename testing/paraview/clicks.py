# SPDX-License-Identifier: BSD-3-Clause
"""Clicks in the application, as ParaView's own player takes them."""
WINDOW = "pqClientMainWindow"
PANEL = "propertiesDock/propertiesPanel"
PROPERTIES = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel"
BROWSER = "pipelineBrowserDock/pipelineBrowser"
DIALOG = "SelectInputDialog"


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
