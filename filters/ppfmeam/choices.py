# SPDX-License-Identifier: BSD-3-Clause
"""The user's choices. choices.json has their names, types, defaults, ranges and help: Python's arguments, the options of
the commands and the filters' XML are made from it, and the tests compare C++, the filters and the documents with it."""
import argparse
import functools
import inspect
import json
import math
import numbers
import operator
import os
import re

from . import Error

with open(os.path.join(os.path.dirname(__file__), "choices.json"), encoding="utf-8") as _file:
    TABLE = json.load(_file)
for _group in TABLE.values():
    _group.update({name: TABLE[choice][name] for name, choice in _group.items() if isinstance(choice, str)})


def wanted(choice):
    """The type and the range of a choice, in words."""
    kind = choice["type"]
    if kind == "choice":
        return "one of " + ", ".join(map(repr, choice["values"]))
    words = {"integer": "a whole number", "number": "a number", "flag": "True or False", "vector": "three numbers"}[kind]
    if "maximum" in choice:
        return f"{words} from {choice['minimum']} to {choice['maximum']}"
    if "minimum" in choice:
        return f"{words}, {choice['minimum']} or more"
    return f"{words} above {choice['above']}" if "above" in choice else words


def converted(choice, value):
    """The value as C++ takes it; throws ValueError or TypeError for a wrong one."""
    kind = choice["type"]
    if value is None and choice.get("default", 0) is None:
        return None
    if kind == "choice":
        if value not in choice["values"]:
            raise ValueError
        return value
    if kind == "flag":
        if value not in (True, False):
            raise ValueError
        return bool(value)
    if kind == "vector":
        value = tuple(map(float, value))
        if len(value) != 3 or not all(map(math.isfinite, value)):
            raise ValueError
        return value
    if isinstance(value, bool) or kind == "number" and not isinstance(value, numbers.Real):
        raise TypeError
    value = operator.index(value) if kind == "integer" else float(value)
    if not math.isfinite(value) or not choice.get("minimum", -math.inf) <= value <= choice.get("maximum", 2**31 - 1) \
            or value <= choice.get("above", -math.inf):
        raise ValueError
    return value


def checked(name, choice, value):
    """The value as C++ takes it, or an Error that names the argument."""
    try:
        return converted(choice, value)
    except (TypeError, ValueError, OverflowError):
        raise Error(f"{name} has to be {wanted(choice)}, not {value!r}") from None


def checked_scale(name, value):
    """A factor that brings lengths to mm."""
    return checked(name, TABLE["train"]["scale"], value)


# Of what is chosen beside the detection.
OTHERS = {"Scale of its reader": ("scale", "--scene-scale"), "CADScale": ("cad_scale", "--cad-scale")}
is_command = False  # scripting.run() is one: texts name its options


def worded(text):
    """A text of the library, which names properties of the filters, with the names of Python's arguments or of a command's options
    in their place."""
    for name, choice in (*TABLE["detect"].items(), *TABLE["plan"].items()):
        name = choice.get("option") if is_command else name
        if name and choice["type"] == "choice":
            for word, value in choice["values"].items():
                text = text.replace(f"{choice['property']}: {value}", f"{name} {word}" if is_command else f"{name}={word!r}")
        elif name:
            text = named(text, choice["property"], name)
    for property, (argument, option) in OTHERS.items():
        text = named(text, property, option if is_command else argument)
    return text


def named(text, property, name):
    """The text with a name in place of a property's; names of files stay as they are."""
    return re.sub(rf"(?<![\w/]){property}(?![\w/])", name, text)


class Chosen:
    """What a user has chosen of a group of the table, by name."""

    def __init__(self, group, given):
        self.group, self.given = group, given
        self.values = {name: checked(name, choice, given.get(name, choice["default"])) for name, choice in TABLE[group].items()}

    def __getattr__(self, name):
        return self.values[name]

    def differing(self):
        """Those that are not the defaults, by name."""
        return {name: value for name, value in self.values.items()
                if value != converted(TABLE[self.group][name], TABLE[self.group][name]["default"])}

    def apply(self, settings, core):
        """Sets the fields of a C++ struct."""
        for name, choice in TABLE[self.group].items():
            value = self.values[name]
            if choice["type"] == "choice":
                value = getattr(getattr(core, choice["property"]), choice["values"][value])
            setattr(settings, choice["field"], value)
        return settings

    def set(self, filter):
        """Sets the properties of a filter."""
        for name, choice in TABLE[self.group].items():
            value = self.values[name]
            if choice["type"] == "choice":
                getattr(filter, f"Set{choice['property']}To{choice['values'][value]}")()
            else:
                getattr(filter, "Set" + choice["property"])(value)


def takes(**groups):
    """Decorates a function: the choices of the groups are its keyword arguments, which it gets as Chosen, by the parameter that
    is named here; takes(settings="detect")."""
    def decorate(function):
        names = {name: parameter for parameter, group in groups.items() for name in TABLE[group]}

        @functools.wraps(function)
        def call(*arguments, **options):
            given = {parameter: {} for parameter in groups}
            for name in names.keys() & options.keys():
                given[names[name]][name] = options.pop(name)
            return function(*arguments, **options,
                            **{parameter: Chosen(group, given[parameter]) for parameter, group in groups.items()})

        parameters = [p for p in inspect.signature(function).parameters.values() if p.name not in groups]
        choices = [(name, choice) for group in groups.values() for name, choice in TABLE[group].items()]
        call.__signature__ = inspect.Signature(parameters + [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=choice["default"]) for name, choice in choices])
        call.__doc__ = inspect.cleandoc(function.__doc__) + "\n\n" + "\n".join(
            f"{name}: {choice['help']}" + (f" {wanted(choice).capitalize()}." if choice["type"] == "choice" else "")
            for name, choice in choices)
        return call
    return decorate


def number(choice):
    """What argparse makes of the text of an option."""
    def of(text):
        try:
            return converted(choice, (int if choice["type"] == "integer" else float)(text))
        except ValueError:
            raise argparse.ArgumentTypeError(f"it has to be {wanted(choice)}, not {text}") from None
    return of


# Of options that are in no table.
finite, factor = number({"type": "number"}), number({"type": "number", "above": 0})


def add_options(parser, group, *names):
    """Adds the command line options of choices to a parser."""
    for name in names:
        choice = TABLE[group][name]
        kind = choice["type"]
        told = {"dest": choice["option"].lstrip("-").replace("-", "_"), "default": choice["default"],
                "help": choice["help"].replace("%", "%%") + " (default: %(default)s)" * (choice["default"] is not None)}
        if kind == "flag":
            told.update({"dest": name, "action": "store_false", "help": choice["off"]} if choice["default"] else
                        {"dest": name, "action": "store_true", "help": choice["help"].replace("%", "%%")})
        elif kind == "choice":
            told["choices"] = list(choice["values"])
        elif kind == "vector":
            told.update(nargs=3, type=finite, metavar=("X", "Y", "Z"))
        else:
            told.update(type=number(choice), metavar="N" if kind == "integer" else "X")
        parser.add_argument(choice["option"], **told)


def of_options(group, options):
    """What the options of a command chose; the default of what it has no option for."""
    return Chosen(group, {name: getattr(options, name) for name in TABLE[group] if hasattr(options, name)})


def words_of(group, values):
    """The words of a command that choose these values, by name, none of them a default."""
    words = []
    for name, value in values.items():
        choice = TABLE[group][name]
        is_method = name == "preset" and value != "paper"
        words += [choice["option"]] if choice["type"] == "flag" else ["--method" if is_method else choice["option"], str(value)]
    return words
