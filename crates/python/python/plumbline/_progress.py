"""Progress of long work: a bar of tqdm where it is installed."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import Any, Optional, Union

Progress = Union[bool, None, Callable[[str, int, int], object]]


class _Bar:
    """A bar that begins again with every stage."""

    def __init__(self, tqdm: Any) -> None:
        self._tqdm = tqdm
        self._bar: Any = None
        self._stage: Optional[str] = None

    def __call__(self, stage: str, done: int, steps: int) -> None:
        if stage != self._stage:
            self.close()
            self._stage = stage
            self._bar = self._tqdm(total=steps or None, desc=stage, leave=False)
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


@contextlib.contextmanager
def shown(progress: Progress) -> Iterator[Optional[Callable[[str, int, int], object]]]:
    """What long work calls: nothing for ``False``, a bar for ``True``, the caller's own function.

    ``None`` is a bar where tqdm is installed. ``True`` raises ``ImportError`` where it is not.
    """
    if callable(progress):
        yield progress
        return
    if progress is not None and not isinstance(progress, bool):
        raise TypeError(
            f"progress: found {type(progress).__name__}, "
            "True, False, None or a function(stage, done, steps) was expected"
        )
    if progress is False:
        yield None
        return
    try:
        from tqdm.auto import tqdm  # type: ignore[import-untyped,unused-ignore]
    except ImportError:
        if progress:
            raise
        tqdm = None
    if tqdm is None:
        yield None
        return
    bar = _Bar(tqdm)
    try:
        yield bar
    finally:
        bar.close()
