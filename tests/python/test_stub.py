"""The type stub names exactly what the module has."""

import ast
import enum
import inspect
from pathlib import Path

import hapbeam as hb

STUB = ast.parse((Path(hb.__file__).parent / "__init__.pyi").read_text(encoding="utf-8"))
ALIASES = {"Floats"}
SPECIAL = {"__init__", "__len__"}


def named(body):
    """What a body of the stub names."""
    names = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
        elif isinstance(node, ast.Assign):
            names.update(target.id for target in node.targets)
    return names


def members(cls):
    """What a class has of its own; a constructor only if Python may call it."""
    own = {name for name in vars(cls) if not name.startswith("_") or name in SPECIAL}
    if isinstance(vars(cls).get("__init__"), type(object.__init__)):
        own.discard("__init__")
    return own


def test_names_of_the_module():
    assert named(STUB.body) - ALIASES - {"__version__"} == set(hb.__all__)
    assert "__version__" in named(STUB.body) and hb.__version__


def test_members_of_each_class():
    classes = [node for node in STUB.body if isinstance(node, ast.ClassDef)]
    assert len(classes) == sum(inspect.isclass(getattr(hb, name)) for name in hb.__all__)
    for node in classes:
        cls = getattr(hb, node.name)
        if issubclass(cls, enum.Enum):
            stated = {item.targets[0].id: ast.literal_eval(item.value) for item in node.body}
            assert stated == {member.name: member.value for member in cls}, node.name
        else:
            assert named(node.body) == members(cls), node.name
            bases = [base.id for base in node.bases]
            assert bases == [base.__name__ for base in cls.__bases__
                             if base.__module__ == "hapbeam"]


def is_property(function):
    return any(isinstance(d, ast.Name) and d.id == "property" for d in function.decorator_list)


def test_arguments_of_functions_and_methods():
    """pybind11 writes a signature into each docstring: its arguments are those of the stub."""
    def arguments(node):
        return [arg.arg for arg in node.args.args if arg.arg != "self"]

    def check(owner, node):
        doc = getattr(owner, node.name).__doc__ or ""
        lines = [line for line in doc.splitlines() if f"{node.name}(" in line and "->" in line]
        wanted = arguments(node)
        for line in lines:
            inside = line[line.index("(") + 1:line.rindex(") ->")]
            given = [part.split(":")[0].strip() for part in inside.split(", ")
                     if ":" in part and not part.startswith("self")]
            if given == wanted:
                return 1
        assert not lines, (owner, node.name, lines, wanted)
        return 0

    checked = 0
    for node in STUB.body:
        if isinstance(node, ast.FunctionDef):
            checked += check(hb, node)
        elif isinstance(node, ast.ClassDef):
            for item in node.body:
                if isinstance(item, ast.FunctionDef) and not is_property(item):
                    checked += check(getattr(hb, node.name), item)
    assert checked >= 90


def test_everything_public_says_what_it_is():
    for name in hb.__all__:
        assert getattr(hb, name).__doc__, name
