# SPDX-License-Identifier: BSD-3-Clause
"""Clicks in the application, as ParaView's own player takes them, and the application that plays them."""
import os
import subprocess
import time
from xml.sax.saxutils import quoteattr

WINDOW = "pqClientMainWindow"
PANEL = "propertiesDock/propertiesPanel"
PROPERTIES = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel"
BROWSER = "pipelineBrowserDock/pipelineBrowser"
DIALOG = "SelectInputDialog"
CONTROL = 0x04000000  # as Qt has it
LONGEST = 180  # seconds, of all clicks
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


def item(tree, *rows, control=False):
    """An entry of a tree, by its row in each level; with Ctrl beside those that are selected."""
    path, modifiers = "/0:0" + "".join(f"/{row}:0" for row in rows), CONTROL if control else 0
    return [event(tree, f"mouse{what}", f"1,{buttons},{modifiers},60,9,{path}") for what, buttons in (("Press", 1), ("Release", 0))]


def connect(name, *rows):
    """An input in the dialog that asks for them."""
    return [event(f"{DIALOG}/buttonFrame/{name}", "set_boolean", "true"), *item(f"{DIALOG}/pipelineView", *rows)]


def accept_inputs():
    return event(f"{DIALOG}/buttonBox/1QPushButton0", "activate")


def choice(name, text):
    return event(f"{PROPERTIES}/{name}/ComboBox", "set_string", text)


def number(name, value):
    return event(f"{PROPERTIES}/{name}/DoubleLineEdit0", "set_string", str(value))


def share(name, value):
    """A number that has a slider."""
    return event(f"{PROPERTIES}/{name}/DoubleRangeWidget/DoubleLineEdit", "set_string", str(value))


def view(cell):
    """The picture in a cell of the layout: 0 of all, 1 and 2 are its halves."""
    return f"{VIEWS}/Frame.{cell}/CentralWidgetFrame/Viewport"


def point_and_press(picture, x, y, key, control=False):
    """The mouse to a place in a picture, both from 0 to 1, and a letter."""
    press, modifiers = 6, CONTROL if control else 0  # as Qt has them
    return [event(picture, "mouseMove", f"({x},{y},0,0,0)"), event(picture, "keyEvent", f"{press}:{ord(key)}:{modifiers}::0:1")]


def expect(widget, name, value):
    return f'<pqcheck object="{WINDOW}/{widget}" property="{name}" arguments={quoteattr(value, {chr(10): "&#10;"})} />'


NEW_PART = menu("menu_Help", "actionPPFMEAMNewPart")
PAGE = "PPFMEAMNewPart/Page"
START = event(f"{PAGE}/Start", "activate")


def new_part_field(name):
    return f"{PAGE}/Area/qt_scrollarea_viewport/Fields/{name}"


def new_part_file(field, path):
    return event(f"{new_part_field(field)}/FileLineEdit", "set_string", path)


def new_part_choice(field, text):
    return event(new_part_field(field), "set_string", text)


def new_part_number(field, number):
    return event(new_part_field(field), "set_int", str(number))


def new_part_length(field, millimetres):
    return event(new_part_field(field), "set_double", str(millimetres))


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def start(paraview, folder, events, *options):
    """The application plays the events with the settings of a new user."""
    script = os.path.join(folder, "clicks.xml")
    with open(script, "w") as file:
        file.write('<?xml version="1.0" ?>\n<pqevents>\n' + "\n".join(events) + "\n</pqevents>\n")
    environment = dict(os.environ, HOME=folder, XDG_CONFIG_HOME=os.path.join(folder, "config"))
    return subprocess.Popen([paraview, "--dr", f"--test-script={script}", *options], env=environment, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def play(paraview, folder, events, *options):
    said, _ = start(paraview, folder, events, "--exit", *options).communicate(timeout=LONGEST)
    errors = [line for line in said.splitlines() if "ERR|" in line or "critical" in line]
    check(not errors, f"ParaView says {errors}")
    check("Success =  true" in said, f"the clicks led nowhere: {said[-3000:]}")


def shoot(paraview, folder, events, picture, *options):
    """The whole window after the events."""
    from PIL import ImageGrab

    done = os.path.join(folder, "done.pvsm")
    application = start(paraview, folder, events + files("actionFileSaveServerState", "FileSaveServerStateDialog", done), *options)
    until = time.monotonic() + LONGEST
    while not os.path.exists(done):
        if application.poll() is not None or time.monotonic() > until:
            application.kill()
            raise AssertionError(f"the clicks led nowhere: {application.communicate()[0][-3000:]}")
        time.sleep(0.2)
    time.sleep(2)
    window = ImageGrab.grab(xdisplay=os.environ["DISPLAY"])
    window.crop(window.getbbox()).save(picture, quality=85)
    application.kill()
    application.wait()
    os.remove(done)
