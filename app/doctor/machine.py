"""Checks of the machine: Python, libraries, the port, the language model's server."""

from __future__ import annotations

import contextlib
import errno
import importlib
import importlib.metadata
import json
import os
import platform
import socket
from collections.abc import Iterator
from pathlib import Path

import httpx
from packaging.requirements import Requirement

from app.doctor.finding import Finding, Health
from planner.errors import BadModelSpec
from planner.models.exchange import host_of
from planner.models.spec import ModelSpec, parse_spec

PACKAGE = "majordomo"
PYTHONS = ("3.11", "3.12", "3.13")
IMPORTED = ("numpy", "scipy", "gtsam", "cv2", "onnxruntime", "filterpy", "igraph", "pybullet", "py_trees", "lark")
"""Libraries with compiled parts, or the first to break: being installed does not mean that they load."""
REINSTALL = "run make install, or pip install --upgrade majordomo"
UNUSED = "none is configured: the command grammar answers alone"


def python() -> Finding:
    """The interpreter's version."""
    version = platform.python_version()
    if version.startswith(tuple(f"{known}." for known in PYTHONS)):
        return Finding(name="python", text=version)
    advice = f"use Python {' or '.join(PYTHONS)}, for which every library has wheels; make install finds or fetches one"
    return Finding(name="python", health=Health.BAD, text=version, advice=advice)


def libraries() -> Finding:
    """Whether every library that the package asks for is there in a version that it takes, and loads."""
    flaws = [*_versions(importlib.metadata.requires(PACKAGE) or ()), *_broken(IMPORTED)]
    if flaws:
        return Finding(name="libraries", health=Health.BAD, text="; ".join(flaws), advice=REINSTALL)
    return Finding(name="libraries", text="all there, in versions that fit, and they load")


def _versions(wanted: list[str] | tuple[str, ...]) -> Iterator[str]:
    """What is missing, or too old or new, of the requirements that hold without extras."""
    for line in wanted:
        requirement = Requirement(line)
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": ""}):
            continue
        try:
            version = importlib.metadata.version(requirement.name)
        except importlib.metadata.PackageNotFoundError:
            yield f"{requirement.name} is missing"
            continue
        if not requirement.specifier.contains(version, prereleases=True):
            yield f"{requirement.name} is {version}, wanted is {requirement.specifier}"


def _broken(names: tuple[str, ...]) -> Iterator[str]:
    for name in names:
        try:
            importlib.import_module(name)
        except ImportError as error:
            yield f"{name} cannot be imported ({error})"


def port(host: str, number: int, data: Path) -> Finding:
    """Whether the service could listen, or does already."""
    if number == 0:
        return Finding(name="port", text="a free one is picked")
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with contextlib.closing(socket.socket(family, socket.SOCK_STREAM)) as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((host, number))
        except OSError as error:
            return _port_not_free(host, number, data, error)
    return Finding(name="port", text=f"{host}:{number} is free")


def _port_not_free(host: str, number: int, data: Path, error: OSError) -> Finding:
    if error.errno == errno.EADDRINUSE:
        if _own_service(data) == number:
            return Finding(name="port", text=f"the service of {data} listens on {number}")
        text, advice = f"{host}:{number} is taken", "stop who listens there, or serve with --port 0"
        return Finding(name="port", health=Health.BAD, text=text, advice=advice)
    advice = "name an address of this machine with --host, or leave the option away"
    return Finding(name="port", health=Health.BAD, text=f"{host}:{number}: {error.strerror or error}", advice=advice)


def _own_service(data: Path) -> int | None:
    """Port of the service that runs with this data folder."""
    try:
        known = json.loads((data / "service.json").read_text(encoding="ascii"))
        os.kill(int(known["pid"]), 0)
        return httpx.URL(known["address"]).port
    except (OSError, ValueError, LookupError, TypeError):
        return None


def language_model(llm: str | None, url: str | None, key: str | None, http: httpx.Client) -> Finding:
    """Whether the configured language model's server answers, takes the key and has the model. No key is told."""
    if llm is None:
        text = UNUSED if url is None else f"{UNUSED}; {host_of(url)} is given, but no model"
        advice = "" if url is None else "name it: majordomo serve --llm PROVIDER:MODEL, and here likewise"
        return Finding(name="model", health=Health.WELL if url is None else Health.ODD, text=text, advice=advice)
    try:
        spec = parse_spec(llm, base_url=url)
    except BadModelSpec as error:
        return Finding(name="model", health=Health.BAD, text=str(error), advice="see README, Use")
    return _asked(spec, (key or "").strip(), http)


def _asked(spec: ModelSpec, key: str, http: httpx.Client, *, timeout_s: float = 5.0) -> Finding:
    try:
        response = http.get(_listing(spec), headers=_headers(spec.provider, key), timeout=timeout_s)
    except (httpx.HTTPError, httpx.InvalidURL, UnicodeEncodeError, ValueError) as error:
        text = f"{spec.host} does not answer ({type(error).__name__})"
        advice = "start its server, or correct MAJORDOMO_LLM_URL; until then the grammar answers alone"
        return Finding(name="model", health=Health.BAD, text=text, advice=advice)
    if response.status_code in (401, 403):
        text = f"{spec.host} does not accept {'the key' if key else 'calls without a key'}"
        advice = "put the key into MAJORDOMO_LLM_KEY, or into a file that MAJORDOMO_LLM_KEY_FILE names"
        return Finding(name="model", health=Health.BAD, text=text, advice=advice)
    if response.is_success and spec.model not in response.text:
        text = f"{spec.host} answers, but does not list {spec.model}"
        advice = f"ollama pull {spec.model}" if spec.provider == "ollama" else "check the name of the model"
        return Finding(name="model", health=Health.ODD, text=text, advice=advice)
    return Finding(name="model", text=f"{spec.host} answers, for {spec.provider}:{spec.model}")


def _listing(spec: ModelSpec) -> str:
    """Where a server lists its models; asking costs nothing."""
    base = spec.base_url.rstrip("/")
    match spec.provider:
        case "ollama":
            return f"{base.removesuffix('/v1').removesuffix('/api')}/api/tags"
        case "anthropic":
            return f"{base.removesuffix('/v1')}/v1/models"
        case _:
            return f"{base}/models"


def _headers(provider: str, key: str) -> dict[str, str]:
    if not key:
        return {}
    anthropic = {"x-api-key": key, "anthropic-version": "2023-06-01"}
    return anthropic if provider == "anthropic" else {"Authorization": f"Bearer {key}"}
