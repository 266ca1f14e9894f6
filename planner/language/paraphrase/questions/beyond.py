"""What is asked of a person, a clock or a telephone: put as what the robot cannot do, and declined by that name."""

from __future__ import annotations

_END = (
    r"(?: (?:now|right now|today|tomorrow|tonight|outside|out there|here|please|again|like|this week"
    r"|at the moment))*(?=[?.!]*$)"
)
_NUMBER = r"(?:\d+|one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|twenty|hundred)"
_US = r"(?:me|us)"

BEYOND: tuple[tuple[str, str], ...] = (
    (
        (
            rf"^(?:can you |could you |do you know |tell me |please )*(?:what|which|what is|what is the|how late "
            rf"is|how late)"
            rf" (?:the )?(?:current )?(?:time|day|date|year|month|hour|weekday)(?: of (?:day|the week))?(?: "
            rf"(?:is it|is today|it is"
            rf"|do we have|have we got))?{_END}"
        ),
        "tell the time",
    ),
    (
        (
            rf"^(?:can you |could you |do you know |tell me |please )*(?:what is|how is|what will|how will)? ?(?:the )?"
            rf"(?:weather|temperature|forecast|news|score)(?: (?:is|be|going to be|forecast))?{_END}"
        ),
        "tell the weather",
    ),
    (
        (
            rf"^(?:is|will|does) it (?:be )?(?:going to )?(?:rain|raining|snow|snowing|sunny|windy|freezing"
            rf"|storm)\w*{_END}"
        ),
        "tell the weather",
    ),
    (rf"^how (?:warm|cold|hot|windy) (?:is|will) it(?: be)?{_END}", "tell the weather"),
    (
        (
            rf"^(?:what|how many|how much) (?:is|are|do|does|makes) {_NUMBER} (?:plus|minus|times|and|divided by|x"
            rf"|\\+|\\*|/|-) {_NUMBER}{_END}"
        ),
        "calculate it",
    ),
    (
        (
            r"^who (?:is|was) the (?:president|king|queen|prime minister|chancellor|pope|mayor)\b.*$|"
            r"^who (?:won|wrote|invented|discovered|painted|directed|composed|sings|sang) .*$|"
            r"^what is the (?:capital|population|meaning|price|cost|currency|square root) of .*$"
        ),
        "answer it",
    ),
    (r"\bset (?=(?:an?|the|my) (?:\w+ )?(?:alarm|timer|reminder|clock|appointment)\b)", "schedule "),
    (
        r"\bset (?=the (?:\w+ )?(?:temperature|heating|thermostat|volume|brightness|oven|air conditioning|channel)\b)",
        "turn on ",
    ),
    (
        (
            r"^(?:please |can you |could you |will you )*set the (?:dinner |dining |breakfast |lunch "
            r")?table(?: for \w+)?(?=[.!?]*$)"
        ),
        "prepare the table",
    ),
    (
        (
            rf"\b(?:carry|lift|fly|ride|bring|take|drive|walk) ({_US}) (?:over |back |home |along )?(?=(?:to"
            rf"|into|home|upstairs|downstairs|outside)\b)(?!to me\b)"
        ),
        r"guide \1 ",
    ),
    (rf"\bgive ({_US}) a (?:lift|ride|tour)\b", r"guide \1"),
    (rf"\bgive ({_US}) a (?:big |little )?(hug|kiss|massage|bath|shower|haircut)\b", r"hug \1"),
)
"""Before all other rules that read requests."""
