"""Takes secrets out of what is kept: those that are known, and what looks like one."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from typing import Any

HIDDEN = "[secret]"
LONGEST = 20_000
"""Characters of one text; of a longer one the middle is left out."""
_SHORTEST = 6
"""A shorter secret would be found in ordinary words."""
_LOOKS_SECRET = (
    re.compile(r"(?i)(?<=\bbearer )[\w.~+/=-]{8,}"),
    re.compile(r"(?i)(?<=token=)[\w.~+/%-]{8,}"),
    re.compile(r"(?i)(?<=api[-_ ]key[:=] )\S{8,}|(?<=api[-_ ]key[:=])\S{8,}"),
    re.compile(r"\b(?:sk|pk|ghp|gho|xox[abp])[-_][A-Za-z0-9_-]{16,}"),
    re.compile(r"(?<=://)[^/\s:@]+:[^/\s@]+(?=@)"),
)


class Redactor:
    """Replaces secrets in texts and plain data.

    Args:
        secrets: what must not appear anywhere, such as the key of a language model; empty ones do not count.
    """

    def __init__(self, secrets: Collection[str | None] = ()) -> None:
        known = sorted({secret for secret in secrets if secret and len(secret) >= _SHORTEST}, key=len, reverse=True)
        self._known = re.compile("|".join(map(re.escape, known))) if known else None

    def text(self, text: str) -> str:
        """The text without secrets, cut in the middle if it is very long."""
        if self._known is not None:
            text = self._known.sub(HIDDEN, text)
        for pattern in _LOOKS_SECRET:
            text = pattern.sub(HIDDEN, text)
        if len(text) <= LONGEST:
            return text
        left_out = len(text) - LONGEST
        return f"{text[: LONGEST // 2]} … ({left_out} characters left out) … {text[-LONGEST // 2 :]}"

    def data(self, data: Any) -> Any:
        """Plain data with all texts in it redacted, keys too."""
        if isinstance(data, str):
            return self.text(data)
        if isinstance(data, Mapping):
            return {self.text(str(key)): self.data(value) for key, value in data.items()}
        if isinstance(data, list | tuple):
            return [self.data(value) for value in data]
        return data
