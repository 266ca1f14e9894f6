"""*Tidy the bench: tools to the office, cups on the shelf*: what a heading says holds for each part that follows."""

from __future__ import annotations

import re

from planner.language.lexicon.vocabulary import singular

_HEADING = re.compile(
    r"^(?:please |can you |could you |would you |will you |let us |time to )*(?:(?:free(?= up)"
    r"|tidy|clean|clear|sort|organi[sz]e|straighten|arrange|empty"
    r"|unload)(?: (?:up|out|off|away))?(?: (?:a (?:little )?bit|a little|please))?"
    r"|(?:get|put|bring|set)(?= [\w' ]+? in(?:to)? (?:order|shape)\b))"
    r" ?(?P<what>[\w' ]*?)(?: in(?:to)? (?:order|shape)| by (?:colou?r|size|kind|type))?\s*"
    r"(?::|,| -|;|\.|\?| by putting| and put)\s+(?P<rest>.+)$"
)
_PART = re.compile(
    r"^(?:and |then |please )*(?:put |move |bring |take )?(?P<things>.+?)(?: should| must| can| may)?"
    r"(?: go| goes| belongs?| be)? (?:back )?(?P<way>to|into|in|on|onto|next to)"
    r" (?P<place>(?!(?:it|them|there)\b)(?:the|a|my|his|her|\w+)\b.*)$"
)
_COMMAS = re.compile(
    r"[,;.]\s+(?:and |then )*| and (?=(?:the |all |every |put )?(?:[\w']+ ){1,3}?(?:to|into|onto|go|goes|belongs"
    r"?)\b|(?:the )?\w+ ones? )"
)
_ON_IT = re.compile(r"^(.+?) (?:(?:up)?on|in|from|inside) (?:it|them|there)(?= )")
"""*The things on it*, after *empty the counter*: on what the heading names."""
_EVERY = re.compile(r"^(?:the |all (?:of )?(?:the )?|every |any |each )+")
_ONES = re.compile(r"\bones?$")
_STAYS = re.compile(
    r" (?:can |may |should )?(?:stays?|remains?|(?:is|are) fine)(?: (?:there|here|put|as (?:it|they) (?:is|are)))?$"
)
_OPENING = (
    "everything",
    "whatever",
    "anything",
    "it",
    "them",
    "it all",
    "all of it",
    "the lot",
    "lot",
    "all",
    "things",
    "stuff",
    "contents",
)
_ELSE = ("everything else", "all else", "rest", "others", "anything else")


def spelled_out(text: str) -> str:
    """A heading and its parts as requests of their own; any other text as it is."""
    found = _HEADING.match(text)
    if found is None:
        return text
    what = re.sub(r"^(?:the|my|our|all|all the|this|that|up)\b ?", "", found["what"].strip())
    parts: list[str] = []
    named: list[str] = []
    open_part = ""
    for part in _COMMAS.split(found["rest"].rstrip(" .!")):
        if _STAYS.search(part) and not open_part:
            continue
        said = _ON_IT.sub(r"\1", f"{open_part} and {part}" if open_part else part)
        matched = _PART.match(said)
        open_part = "" if matched else said
        if matched and _EVERY.sub("", matched["things"]) in _ELSE:
            if not (what and named):
                return text
            parts.append(
                f"put everything from {_the(what)} {matched['way']} {matched['place']} except {' and '.join(named)}"
            )
        elif matched:
            named.append(matched["things"] if matched["things"].startswith("the ") else f"the {matched['things']}")
            parts.append(f"put {_things(matched['things'], what)} {matched['way']} {matched['place']}")
    return ", then ".join(parts) if parts and not open_part.strip() else text


def _things(said: str, what: str) -> str:
    bare = _EVERY.sub("", said)
    if bare in _OPENING:
        return f"everything from {_the(what)}" if what else said
    if _ONES.search(bare) and what:
        one = singular(what) if bare.endswith("one") else what
        return f"{'the' if one != what else 'all the'} {_ONES.sub(one, bare)}"
    several = bare.endswith("s") or bare != said.removeprefix("the ")
    from_there = f" from {_the(what)}" if what and " from " not in bare and " in " not in bare else ""
    return f"{'all the' if several else 'the'} {bare}{from_there}"


def _the(what: str) -> str:
    """*The desk*, but *Anna's desk*."""
    return what if what.split(maxsplit=1)[0].endswith("'s") else f"the {what}"
