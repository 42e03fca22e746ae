"""Arguments as the functions of Rust take them. Each raises ``TypeError`` or ``ValueError`` that names the argument."""

from __future__ import annotations

import math
import operator
import os
from collections.abc import Iterable
from numbers import Real
from typing import Any, Optional

_LARGEST = 2**63 - 1


def _wrong(name: str, value: object, expected: str) -> TypeError:
    return TypeError(f"{name}: found {type(value).__name__}, {expected} was expected")


def text(name: str, value: Any) -> str:
    """A string that can be written as UTF-8."""
    if not isinstance(value, str):
        raise _wrong(name, value, "a string")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise ValueError(f"{name}: found {value!r}, a string without surrogates was expected") from None
    return value


def texts(name: str, values: Any) -> list[str]:
    """Strings, in a list or anything else that has one after the other."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise _wrong(name, values, "a list of strings")
    return [text(name, value) for value in values]


def path(name: str, value: Any) -> str:
    """The path of a file or folder."""
    try:
        found = os.fspath(value)
    except TypeError:
        raise _wrong(name, value, "a path") from None
    if not isinstance(found, str):
        raise _wrong(name, found, "a path")
    return found


def number(name: str, value: Any) -> float:
    """A finite number."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise _wrong(name, value, "a number")
    if not math.isfinite(value):
        raise ValueError(f"{name}: found {value}, a finite number was expected")
    return float(value)


def count(name: str, value: Any) -> int:
    """A whole number from 0 on."""
    try:
        found = operator.index(value)
    except TypeError:
        raise _wrong(name, value, "a whole number") from None
    if not 0 <= found <= _LARGEST:
        raise ValueError(f"{name}: found {found}, a whole number from 0 to {_LARGEST} was expected")
    return found


def flag(name: str, value: Any) -> bool:
    """``True`` or ``False``."""
    if not isinstance(value, bool):
        raise _wrong(name, value, "True or False")
    return value


def number_or_none(name: str, value: Any) -> Optional[float]:
    """A finite number, where there is one."""
    return None if value is None else number(name, value)


def count_or_none(name: str, value: Any) -> Optional[int]:
    """A whole number, where there is one."""
    return None if value is None else count(name, value)


def path_or_none(name: str, value: Any) -> Optional[str]:
    """A path, where there is one."""
    return None if value is None else path(name, value)
