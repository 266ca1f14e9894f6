"""Who may call, and as what: bearer tokens made at first start, one that opens all and one that opens reading."""

from __future__ import annotations

import hmac
import ipaddress
import os
import secrets
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from starlette.requests import HTTPConnection

OPERATOR_FILE = "token"
VIEWER_FILE = "viewer-token"


class Role(StrEnum):
    """What a token lets its bearer do: a viewer reads, an operator does everything."""

    VIEWER = "viewer"
    OPERATOR = "operator"


class Token:
    """The bearer token of a service."""

    def __init__(self, value: str) -> None:
        if len(value) < 16:
            raise ValueError("a token needs at least 16 characters")
        self.value = value

    @classmethod
    def stored_in(cls, folder: Path, name: str = OPERATOR_FILE) -> Token:
        """The token kept in file ``name`` of ``folder``, made at first use; readable by its owner only.

        Raises:
            OSError: the file holds something else, or cannot be read or written.
        """
        path = folder / name
        if path.is_file() and (value := path.read_bytes().strip()):
            try:
                return cls(value.decode("ascii"))
            except ValueError as error:
                raise OSError(f"{path} holds no token ({error}): delete it, and a new one is made") from error
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


@dataclass(frozen=True, kw_only=True)
class Access:
    """The tokens of a service; ``viewer`` is ``None`` where only operators are let in."""

    operator: Token
    viewer: Token | None = None

    def role_of(self, offered: str | None) -> Role | None:
        """What the bearer of ``offered`` may do, ``None`` for nothing."""
        if self.operator.admits(offered):
            return Role.OPERATOR
        return Role.VIEWER if self.viewer is not None and self.viewer.admits(offered) else None


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
