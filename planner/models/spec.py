"""From ``provider:model@url`` to a language model. Keys and addresses come as arguments, never from the environment."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import httpx

from planner.errors import BadModelKey, BadModelSpec
from planner.models.anthropic import AnthropicWire
from planner.models.client import HttpModel, Wire
from planner.models.exchange import host_of
from planner.models.ollama import OllamaWire
from planner.models.openai import OpenAIWire
from planner.models.protocol import LanguageModel


@dataclass(frozen=True, kw_only=True)
class Provider:
    """What is assumed of a provider unless it is said otherwise; ``wire`` takes model and context length."""

    base_url: str
    context_tokens: int
    wire: Callable[[str, int], Wire]
    needs_key: bool = False


PROVIDERS = {
    "openai": Provider(
        base_url="https://api.openai.com/v1",
        context_tokens=32_768,
        wire=lambda model, _context: OpenAIWire(model=model),
    ),
    "ollama": Provider(
        base_url="http://127.0.0.1:11434",
        context_tokens=32_768,
        wire=lambda model, context: OllamaWire(model=model, context_tokens=context),
    ),
    "anthropic": Provider(
        base_url="https://api.anthropic.com",
        context_tokens=200_000,
        wire=lambda model, _context: AnthropicWire(model=model),
        needs_key=True,
    ),
}
EXPECTED = (
    f"{', '.join(f'{name}:MODEL' for name in PROVIDERS)}, or one of these followed by @URL, "
    "such as openai:qwen2.5@http://127.0.0.1:8000/v1"
)


@dataclass(frozen=True, kw_only=True)
class ModelSpec:
    """Which model, and where."""

    provider: str
    model: str
    base_url: str

    @property
    def host(self) -> str:
        """Host and port of its server."""
        return host_of(self.base_url)


def parse_spec(text: str, *, base_url: str | None = None) -> ModelSpec:
    """Read ``provider:model`` or ``provider:model@url``; ``base_url`` is used when the text names none.

    Raises:
        BadModelSpec: saying what is expected.
    """
    provider, colon, rest = text.strip().partition(":")
    model, _, url = rest.partition("@http")
    if not colon or provider not in PROVIDERS or not model:
        raise BadModelSpec(text, EXPECTED)
    address = f"http{url}" if url else base_url or PROVIDERS[provider].base_url
    if not address.startswith(("http://", "https://")):
        raise BadModelSpec(text, EXPECTED)
    return ModelSpec(provider=provider, model=model, base_url=address)


def language_model(
    spec: ModelSpec, *, http: httpx.AsyncClient, key: str | None = None, context_tokens: int | None = None
) -> LanguageModel:
    """The client of a specified model; ``context_tokens`` is the provider's when it is not given.

    Raises:
        BadModelKey: there is no key and the provider wants one, or it has characters that no key has.
    """
    provider, key = PROVIDERS[spec.provider], (key or "").strip()
    if provider.needs_key and not key:
        raise BadModelKey(spec.provider, "there is none")
    if not (key.isascii() and (key.isprintable() or not key)):
        raise BadModelKey(spec.provider, "it has characters that no key has")
    context = context_tokens or provider.context_tokens
    return HttpModel(
        provider.wire(spec.model, context), base_url=spec.base_url, http=http, key=key, context_tokens=context
    )
