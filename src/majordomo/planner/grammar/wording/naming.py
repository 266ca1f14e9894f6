"""Ways of teaching a name: *from now on we call this the den*."""

from __future__ import annotations

NAMING: tuple[tuple[str, str], ...] = (
    ("^(?:we|i|you|they) (?:are|will be) (?:calling|naming) ", "call "),
    (r"^(the .+?) belongs to \w+[,;.]+ (?:and |so )?(?:it|that|this) is (?=(?:my|\w+'s|our)\b)", r"call \1 "),
    ("^this (?:here|room here|place here|one here) is ", "this is "),
    (
        (
            "^(?:just so you know|for your information|fyi|remember this|note this|learn this|please note"
            "|by the way|btw|listen)[,.:;]* "
        ),
        "",
    ),
    (r"\b(?:from now on|in future|in the future|henceforth|as of now)[,:]* (?=\w)", ""),
    ("[, ]+(?:from now on|in future|in the future|henceforth)(?=$|[.!])", ""),
    ("^(?:please )?(?:remember|note|know|keep in mind|learn|be aware|memorize|do not forget)(?: that|:|,)+ ", ""),
    (r"^you are (?:now )?in (?=(?:the|my) [\w ]+$)", "this room is "),
    (
        (
            "^(?:this room|the room (?:we|you) are in|where (?:we|you) are(?: now)?|this place"
            "|the room you are in now) (?:should be|will be|shall be|is) (?:known as|called|named) "
        ),
        "this room is called ",
    ),
    (
        (
            "^(?:let us|we|i|people|they|everyone|everybody|you (?:can|should|may|must))(?: all)?(?: will"
            r"| always)? (?:call|name|refer to) (.+?)(?: as)? (the|my|our|\w+'s) "
        ),
        r"call \1 \2 ",
    ),
    ("^(?:please )?(?:name|title|label|refer to|treat|think of|regard|know|remember|learn) (.+?) as ", r"call \1 "),
    (r"^(?:please )?name (?=(?:this|that|the|it)\b)(?!the rooms)", "call "),
    ("^(?:the |this )?(.+?)'s name is ", r"\1 is called "),
    ("^(?:the )?name of (.+?) is ", r"\1 is called "),
    (r"\b(?:should|shall|will|is to|must|can) be (?:called|named|known as) ", "is called "),
    (r"\b(?:is|are) (?:now |also |actually |really |always )+(?=(?:the|my|our|called|\w+'s)\b)", "is "),
    (r"\bgoes by(?: the name(?: of)?)? ", "is called "),
    (
        ("^(?:i am called|call me|you (?:can|may|should) call me|people call me|they call me|my name(?: here)? is) "),
        "my name is ",
    ),
)
"""In the order in which they are tried."""
