"""What is known of the effects that a diagnosis can name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from plumbline import _arguments, _plumbline


@dataclass(frozen=True)
class Effect:
    """An effect of the catalogue; ``print`` gives what ``plumbline explain`` prints."""

    code: str
    """Code, such as ``FR02``."""
    name: str
    """Name, such as ``coulomb_friction``."""
    facts: Mapping[str, str]
    """What is known of it, by the words of ``plumbline explain``: ``is``, ``adds``, ``shows as`` and others, with its
    parameters."""
    text: str
    """All of it as text."""

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<Effect {self.code} {self.name}>"


def explain(effect: str) -> Effect:
    """What is known of an effect, by its code or name: how it shows, and what it is confused with.

    Raises ``PlumblineError`` for a name that the catalogue lacks.
    """
    return _of(_plumbline.explain(_arguments.text("effect", effect)))


def effects() -> tuple[Effect, ...]:
    """Every effect of the catalogue."""
    return tuple(_of(effect) for effect in _plumbline.effects())


def _of(native: _plumbline.Effect) -> Effect:
    return Effect(native.code, native.name, dict(native.facts), native.text)
