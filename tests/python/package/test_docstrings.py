"""The docstrings are a manual: each call documents its arguments, results and exceptions."""

import builtins
import inspect
import re

import pytest

import kinegraph as ry

SECTIONS = ("Args", "Returns", "Raises")
SAYS_ALL = re.compile(r"The same as (\w+)(?:\(\))?[.,]")  # its target describes an alias
MAY_BE_WRONG = re.compile(r"ArrayLike|PathLike|\bFrame\b|Sequence|Mapping|Iterable|Callable|Annotated")
NO_ARGUMENTS = {"self", "/", "*"}


def public_callables():
    """(name, callable, owner) of all functions and methods that the package exports, and of its classes'
    constructors."""
    for name in ry.__all__:
        value = getattr(ry, name)
        if inspect.isclass(value):
            if hasattr(value, "__members__") or issubclass(value, BaseException):
                continue
            for method, member in vars(value).items():
                if callable(member) and (not method.startswith("_") or method == "__init__"):
                    yield f"{name}.{method}", member, value
        elif callable(value):
            yield name, value, ry


CALLABLES = list(public_callables())


def python_call(member):
    """The signature of a Python function, with its return type."""
    signature = inspect.signature(member)
    returned = str(signature.return_annotation) if signature.return_annotation is not signature.empty else "None"
    arguments = {parameter.name: str(parameter.annotation) for parameter in signature.parameters.values()}
    return [(arguments, returned, inspect.getdoc(member) or "")]


def split_arguments(text):
    """name -> annotation of `self, a: int = 3, *, b: tuple[int, str]`, with ** before that of keywords of any name."""
    parts, depth, quote = [""], 0, ""
    for c in text:
        if quote:
            quote = "" if c == quote else quote
        elif c in "'\"":
            quote = c
        depth += (c in "([{") - (c in ")]}")
        if c == "," and depth == 0 and not quote:
            parts.append("")
        else:
            parts[-1] += c
    named = (re.match(r"\s*(\**)(\w+)(?::\s*(.*?))?(?:\s*=.*)?$", part, re.DOTALL) for part in parts)
    return {m[2]: ("**" if m[1] == "**" else "") + (m[3] or "") for m in named if m}


def compiled_calls(name, member):
    """The overloads of a compiled function: arguments, return type and text, one for all or one for each."""
    text = member.__doc__ or ""
    head = re.compile(rf"^{name}\((.*)\)(?: -> (.*))?$")
    lines = text.splitlines()
    count = next((i for i, line in enumerate(lines) if not head.match(line)), len(lines))
    signatures = [head.match(line) for line in lines[:count]]
    body = "\n".join(lines[count:]).strip()
    texts = re.split(r"^\d+\. ``.*``$", body, flags=re.MULTILINE)[1:] if body.startswith("Overloaded") else []
    texts = texts or [body] * len(signatures)
    texts = [said if said.strip() else texts[0] for said in texts]  # other types, the same call
    return [(split_arguments(m[1]), m[2] or "None", said.strip()) for m, said in zip(signatures, texts, strict=True)]


def calls(name, member):
    compiled = "nanobind" in type(member).__module__ or type(member).__name__.startswith("nb_")
    return compiled_calls(name.split(".")[-1], member) if compiled else python_call(member)


def section(text, name):
    """The lines of a section, without their indentation; None if there is none."""
    found = re.search(rf"^{name}:\n((?:    .*\n?|\n)+)", text + "\n", re.MULTILINE)
    return inspect.cleandoc(found[1]).splitlines() if found else None


def entries(lines):
    named = (re.match(r"(\w+(?:, \w+)*): ", line) for line in lines or [])
    return [name for m in named if m for name in m[1].split(", ")]


def complaints(name, member):
    found = []
    for arguments, returned, text in calls(name, member):
        named = [argument for argument in arguments if argument not in NO_ARGUMENTS]
        if not text:
            found.append("no description")
        elif SAYS_ALL.match(text) or text.startswith("The same with"):
            continue
        said = entries(section(text, "Args"))
        if named and arguments[named[-1]].startswith("**"):
            said = said[: len(named)]  # after it come the keywords that there are
        if named and said != named:
            found.append(f"Args are {said}; the signature has {named}")
        if named and returned not in ("None", "NoneType") and not section(text, "Returns"):
            found.append(f"returns {returned}, and does not say what")
        if any(MAY_BE_WRONG.search(kind) for kind in arguments.values()) and not section(text, "Raises"):
            found.append("no Raises, though an argument can be wrong")
        if not named and "NDArray" in returned and not re.search(r"\((\d|\w+,)", text):
            found.append("no shape of what it returns")
    return found


@pytest.mark.parametrize("name, member, owner", CALLABLES, ids=[name for name, _, _ in CALLABLES])
def test_a_call_says_its_arguments_what_it_returns_and_what_it_raises(name, member, owner):
    if name.endswith("__init__") and "Initialize self" in (member.__doc__ or ""):
        return  # made by the library only
    assert complaints(name, member) == []


@pytest.mark.parametrize("name, member, owner", CALLABLES, ids=[name for name, _, _ in CALLABLES])
def test_what_the_docstring_of_a_call_names_is_there(name, member, owner):
    text = inspect.getdoc(member) or ""
    for error in entries(section(text, "Raises")):
        kind = getattr(ry, error, None) or getattr(builtins, error, None)
        assert inspect.isclass(kind) and issubclass(kind, BaseException), error
    for alias in SAYS_ALL.findall(text):
        assert alias.split(".")[-1] in dir(owner), alias
    order = [word for word in re.findall(r"^(\w+):$", text, re.MULTILINE) if word in SECTIONS]
    assert order == sorted(order, key=SECTIONS.index) or "Overloaded" in text, order


def test_the_check_finds_omissions():
    def moves(q, speed=1.0):
        """Moves.

        Args:
            q: Joint vector.
        """
        return q

    moves.__annotations__["return"] = "ArrayLike"
    moves.__annotations__["q"] = "ArrayLike"
    said = complaints("moves", moves)
    assert [words.split(" ")[0] for words in said] == ["Args", "returns", "no"]
