"""Secrets never reach the log."""

from __future__ import annotations

import io
import logging

from app.commands.log_redaction import RedactingFormatter


def logged(secrets, write):
    lines = io.StringIO()
    handler = logging.StreamHandler(lines)
    handler.setFormatter(RedactingFormatter("%(name)s: %(message)s", secrets=secrets))
    logger = logging.getLogger("test of discretion")
    logger.addHandler(handler)
    logger.propagate = False
    try:
        write(logger)
    finally:
        logger.removeHandler(handler)
    return lines.getvalue()


def test_secrets_are_hidden_in_messages_arguments_addresses_and_stack_traces():
    secrets = ("sk-first/second+third", "a-token-that-is-long", "")

    def write(logger):
        logger.warning("GET /v1/stream?token=a-token-that-is-long")
        logger.warning("header %s, address %s", {"x-api-key": secrets[0]}, "?key=sk-first%2Fsecond%2Bthird")
        try:
            {}[f"refused: {secrets[0]}"]
        except KeyError:
            logger.exception("it failed")

    text = logged(secrets, write)
    assert text.count("[hidden]") == 4
    assert "KeyError: 'refused: [hidden]'" in text
    for part in ("a-token", "sk-first", "second"):
        assert part not in text


def test_without_secrets_lines_are_as_they_were():
    assert logged(("", ""), lambda logger: logger.warning("all %s", "well")) == "test of discretion: all well\n"
