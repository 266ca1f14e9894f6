"""Who may call: a bearer token made at first start, and requests only under names that mean this machine."""

from __future__ import annotations

import hmac
import ipaddress
import os
import secrets
from pathlib import Path

from starlette.requests import HTTPConnection

from majordomo.app.http.problems import Problem


class Token:
    """The bearer token of a service."""

    def __init__(self, value: str) -> None:
        if len(value) < 16:
            raise ValueError("a token needs at least 16 characters")
        self.value = value

    @classmethod
    def stored_in(cls, folder: Path) -> Token:
        """The token kept in ``folder``, made at first use; readable by its owner only."""
        path = folder / "token"
        if path.is_file() and (value := path.read_text(encoding="ascii").strip()):
            return cls(value)
        folder.mkdir(parents=True, exist_ok=True)
        token = cls(secrets.token_urlsafe(24))
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        with os.fdopen(descriptor, "w", encoding="ascii") as file:
            file.write(token.value + "\n")
        return token

    def admits(self, offered: str | None) -> bool:
        """Whether ``offered`` is this token; compared in constant time."""
        return offered is not None and hmac.compare_digest(offered.encode(errors="replace"), self.value.encode())


def offered_token(connection: HTTPConnection) -> str | None:
    """The token in the authorization header or in the query, if any."""
    scheme, _, value = connection.headers.get("authorization", "").partition(" ")
    if scheme.lower() == "bearer" and value:
        return value.strip()
    return connection.query_params.get("token")


class TokenGuard:
    """Dependency that lets a request through only with the token."""

    def __init__(self, token: Token) -> None:
        self._token = token

    def __call__(self, connection: HTTPConnection) -> None:
        if not self._token.admits(offered_token(connection)):
            raise Problem(
                401,
                "unauthorized",
                "a valid bearer token is needed; it is in the address printed at start",
                headers={"WWW-Authenticate": "Bearer"},
            )


def is_loopback(host: str) -> bool:
    """Whether a host name or address means this machine only."""
    return host == "localhost" or (is_address(host) and ipaddress.ip_address(host.strip("[]")).is_loopback)


def is_address(host: str) -> bool:
    """Whether a host is given as an IP address, in brackets or not."""
    try:
        ipaddress.ip_address(host.strip("[]"))
    except ValueError:
        return False
    return True
