"""The findings of a diagnosis, as rows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True)
class Parameter:
    """A size of an effect, in the unit ``unit``."""

    name: str
    value: Optional[float]
    """Best value; ``None`` where it is not finite."""
    ci95: tuple[Optional[float], Optional[float]]
    """95 per cent interval."""
    nominal: Optional[float]
    """Value in the model that was diagnosed."""
    unit: str
    determined: bool
    """Whether the logs narrow it down."""


@dataclass(frozen=True)
class Finding:
    """A named cause."""

    code: str
    """Code of the effect, such as ``FR02``."""
    effect: str
    """Name of the effect, such as ``coulomb_friction``."""
    joint: Optional[str]
    link: Optional[str]
    parameters: tuple[Parameter, ...]
    share_explained: float
    """Share of the nominal residual's power that goes with it, over the joints it acts on."""
    log_evidence: Optional[float]
    """Logarithm of how much more likely the logs are with it than without it."""
    held_out_gain: Optional[float]
    """Relative fall of the held-out residual's power when it is added to the other findings."""
    not_separable_from: tuple[str, ...]
    """What it may as well be, such as ``payload at hand``."""
    evidence: tuple[str, ...]
    """What speaks for it, in sentences."""


class Findings(tuple[Finding, ...]):
    """Named causes, the one with the largest share first."""

    def to_pandas(self) -> pandas.DataFrame:
        """One row a parameter. Raises ``ImportError`` where pandas is not installed."""
        import pandas

        columns = [
            "code", "effect", "joint", "link", "parameter", "value", "low", "high", "nominal", "unit",
            "determined", "share_explained", "log_evidence", "held_out_gain", "not_separable_from",
        ]
        rows = [
            (
                f.code, f.effect, f.joint, f.link, p.name, p.value, *p.ci95, p.nominal, p.unit,
                p.determined, f.share_explained, f.log_evidence, f.held_out_gain,
                ", ".join(f.not_separable_from),
            )
            for f in self
            for p in f.parameters
        ]
        return pandas.DataFrame(rows, columns=columns)


def findings_of(rows: list[dict[str, Any]]) -> Findings:
    """The findings of a ``diagnosis.json``."""
    return Findings(_finding(row) for row in rows)


def _finding(row: Mapping[str, Any]) -> Finding:
    parameters = row["parameters"]
    if isinstance(parameters, Mapping):
        parameters = [{"name": name, **size} for name, size in parameters.items()]
    return Finding(
        code=row["code"],
        effect=row["effect"],
        joint=row.get("joint"),
        link=row.get("link"),
        parameters=tuple(
            Parameter(
                name=p["name"],
                value=p["value"],
                ci95=(p["ci95"][0], p["ci95"][1]),
                nominal=p["nominal"],
                unit=p["unit"],
                determined=p["determined"],
            )
            for p in parameters
        ),
        share_explained=row["share_explained"],
        log_evidence=row["log_evidence"],
        held_out_gain=row["held_out_gain"],
        not_separable_from=tuple(_place(rival) for rival in row["not_separable_from"]),
        evidence=tuple(row["evidence"]),
    )


def _place(at: Mapping[str, Any]) -> str:
    place = at.get("joint") or at.get("link")
    return f"{at['effect']} at {place}" if place else str(at["effect"])
