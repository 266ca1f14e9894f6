"""Where a service is, and how one that runs on this machine is found."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

import httpx

from client.errors import NoService

DEFAULT_DATA = Path("~/.local/share/majordomo")
SERVICE_FILE = "service.json"
"""What a running service leaves in its data folder: address and token."""
_MAX_PORT = 65535
_LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})


@dataclass(frozen=True, kw_only=True)
class Service:
    """Where a service is and the token that opens it."""

    address: str
    token: str = field(repr=False)

    @property
    def headers(self) -> dict[str, str]:
        """What every call carries."""
        return {"Authorization": f"Bearer {self.token}"} if self.token else {}

    @property
    def on_this_machine(self) -> bool:
        """Whether no proxy may come in between."""
        return httpx.URL(self.address).host in _LOOPBACK

    @property
    def stream(self) -> str:
        """Address of the event stream."""
        return f"{self.address.replace('http', 'ws', 1)}/v1/stream"


def find_service(url: str | None = None, token: str | None = None, data: Path = DEFAULT_DATA) -> Service:
    """The service at ``url``, else the one that left its address in the data folder.

    A ``url`` without a token gets the one that the data folder holds: that of the service which left the same
    address there, or, for another port of this machine, the folder's own.

    Raises:
        NoService: saying what to do.
    """
    data = data.expanduser()
    if url is not None:
        return _service_at(url, token, data)
    left = _left_in(data)
    if left is None:
        raise NoService(
            f"no service has left its address in {data}: start one with 'majordomo serve', or, if one runs with "
            "another data folder, name that folder with --data"
        )
    return Service(address=left.address, token=token or left.token)


def _service_at(url: str, token: str | None, data: Path) -> Service:
    try:
        parsed = httpx.URL(url)
    except httpx.InvalidURL as error:
        raise NoService(f"the address {url!r} cannot be used: {error}") from None
    if parsed.port is not None and parsed.port > _MAX_PORT:
        raise NoService(f"the address {url!r} cannot be used: ports end at {_MAX_PORT}")
    address = str(parsed.copy_with(query=None, path="/", fragment=None)).rstrip("/")
    offered = token or parsed.params.get("token") or _known_token(address, parsed.host, data)
    if not offered:
        raise NoService(
            f"the address holds no token, and {data} holds none for it: pass it with --token, or name the data "
            "folder of the service with --data"
        )
    if not offered.isascii():
        raise NoService("the token holds characters that no token has: copy it from the printed address")
    return Service(address=address, token=offered)


def _known_token(address: str, host: str, data: Path) -> str | None:
    """A token for an address of this machine; that of a data folder is sent nowhere else."""
    left = _left_in(data)
    if left is not None and left.address == address:
        return left.token
    if host not in _LOOPBACK:
        return None
    try:
        return (data / "token").read_text(encoding="ascii").strip() or None
    except (OSError, ValueError):
        return None


def _left_in(data: Path) -> Service | None:
    """What a service has left in its data folder, if it can be read."""
    try:
        known = json.loads((data / SERVICE_FILE).read_text(encoding="ascii"))
        return Service(address=str(known["address"]), token=str(known["token"]))
    except (OSError, ValueError, LookupError, TypeError):
        return None
