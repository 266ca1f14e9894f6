"""Keeps secrets out of the log: tokens and keys that were to be written are left out, wherever they came from."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from urllib.parse import quote

HIDDEN = "[hidden]"


class RedactingFormatter(logging.Formatter):
    """A formatter that writes ``[hidden]`` for secrets, in messages and stack traces, also as addresses hold them."""

    def __init__(self, layout: str, *, secrets: Iterable[str]) -> None:
        super().__init__(layout)
        spellings = {spelling for secret in secrets if secret for spelling in (secret, quote(secret, safe=""))}
        self._secrets = sorted(spellings, key=len, reverse=True)

    def format(self, record: logging.LogRecord) -> str:
        """The record as a line, without secrets."""
        line = super().format(record)
        for secret in self._secrets:
            line = line.replace(secret, HIDDEN)
        return line
