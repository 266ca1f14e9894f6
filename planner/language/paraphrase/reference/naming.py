"""Ways of teaching a name: *from now on we call this the den*."""

from __future__ import annotations

_OURS = (
    r"(?:we|i|you|they|people|everyone|everybody|the \w+|\w+s|\w+ people|us \w+|my \w+|our \w+"
    r"|children|folks|staff|locals)"
)
_HABIT = (
    r"(?: (?:all|both|usually|always|normally|often|just|now|like to|tend to|will|would|shall|also|still|have always))*"
)

NAMING: tuple[tuple[str, str], ...] = (
    (r"^(?:the |that |this )((?:\w+ )*?)(\w+) is mine(?=[.!]*$)", r"call the \1\2 my \2"),
    (
        (
            rf"^{_OURS}{_HABIT} (?:call|calls|called|name|named|refer to|label|nickname|dub|know) "
            r"(it|this|that|them)(?: as| by the name)? (?=\w)"
        ),
        r"call \1 ",
    ),
    (
        (
            rf"^{_OURS}{_HABIT} (?:say|use|write) (?:the )?([\w' ]+?) (?:for|instead of|when (?:i|we) mean) "
            r"((?:the|this) [\w' ]+?)(?=[.!]*$)"
        ),
        r"call \2 the \1",
    ),
    (
        (
            r"^((?:the|this) [\w' ]+?) (?:is|are) (?:for|full of|where) [^,.;]+?[,;.]+ (?:so |and )*"
            r"(?:(?:we|i|they|people) (?:all )?)?call (?:it|that|them) (?=\w)"
        ),
        r"call \1 ",
    ),
    (
        (
            r"^(?![^,;:]* (?:is|are|belongs?|has|needs|wants|goes|should|was)\b)((?:the|this) [\w' ]+?)[,;:]+ "
            r"(?:(?:it|that|this) is (?:our|the|my)|(?:we|i) call (?:it|that) "
            r"(?:the|our|my)) ([\w' ]+?)(?: (?:for|to) (?:us|me))?(?=[.!]*$)"
        ),
        r"call \1 the \2",
    ),
    (
        (
            r"^((?:the|this) [\w' ]+?|(?:meeting room|ward|office|classroom) \w+) will be (?=(?:the|my|our|\w+'s)\b)"
            r"([\w' ]+?)(?: (?:this|next|for the|for this) (?:week|month|year|term|day)| today| for now)*(?=[.!]*$)"
        ),
        r"\1 is \2",
    ),
    (r"^its (?:(?:new |proper |real )?name is|called|named) ", "it is called "),
    (
        r"^the room (?:that )?(\w+) is in (?:is|should be|will be) (?=(?:the|my|our|called)\b)",
        r"the room where \1 is is ",
    ),
    (
        (
            rf"^{_OURS}{_HABIT} (?:call|calls|called|name|named|refer to|label|nickname|dub|know)"
            rf"(?: the)? ((?:the |this |my |our )?[\w' ]+?)(?: as| by the name)? (the|my|our|a|an) "
            rf"([\w' ]+?)"
            r"(?:[,.;]* (?:so |and |please )*(?:remember|note|keep|know|mind) (?:that|it|this)"
            r"(?: in mind)?| now| from now on| around here| here)*(?=[.!]*$)"
        ),
        r"call the \1 \2 \3",
    ),
    (
        (
            rf"^{_OURS}{_HABIT} (?:call|calls|called|name|named|label|labeled|nickname|nicknamed|dub|dubbed) "
            rf"(the [\w' ]+?)(?: now"
            rf"| from now on| around here| here| these days)*(?=[.!]*$)"
        ),
        r"call \1",
    ),
    (
        (
            r"^(?:when|if|whenever|every time) (?:i|we|you|someone|people|anyone) (?:say|says|mention"
            r"|mentions|talk about|speak of|ask for|write) (?:the )?([\w' ]+?),? (?:i|we|it|that|they"
            r"|then i) (?:mean|means|meant|am talking about|refer to|refers to|is) (?=the|this|that)"
            r"(.+?)(?=[.!]*$)"
        ),
        r"call \2 the \1",
    ),
    (r"^(?:by|with) (?:the )?([\w' ]+?),? (?:i|we) (?:mean|refer to) (?=the|this)(.+?)(?=[.!]*$)", r"call \2 the \1"),
    (
        (
            r"^(?:the )?[\"']?([\w' ]+?)[\"']? (?:means|stands for|refers to|is short for|is an other "
            r"(?:name|word) for|is what (?:we|i) call) (?=the|this)(.+?)(?=[.!]*$)"
        ),
        r"call \2 the \1",
    ),
    (
        (
            r"^((?:this|the) [\w' ]+?)[?,:;]+ (?:we|i|they|people)(?: all)? (?:say|call it|call this"
            r"|name it|know it as|use|refer to it as) (?:the |our )?([\w' ]+?)(?: (?:for|to) it"
            r"| instead)?(?=[.!]*$)"
        ),
        r"call \1 the \2",
    ),
    (
        (
            r"^(?:let us |we will |you can |please |you should |you may )*(?:baptize|christen|dub"
            r"|nickname|title|term|entitle|designate|tag) "
        ),
        "call ",
    ),
    (r"^call the (the|this|my|our) ", r"call \1 "),
    (
        (
            r"^(?:the )?(?:proper |right |correct |new |official )?(?:name|label|word|term) (?:for|of) "
            r"((?:the|this) [\w' ]+?) (?:is|will be|shall be|should be) (?:the )?"
        ),
        r"call \1 the ",
    ),
    (
        (
            r"^((?:the|this) [\w' ]+?) (?:is|shall be|should be|will be|is to be|gets) (?:now "
            r"|henceforth |hereby )*(?:known|called|named|labeled|renamed|christened|dubbed|nicknamed)"
            r"(?: as| to)? "
        ),
        r"call \1 ",
    ),
    ("^(?:we|i|you|they) (?:are|will be) (?:calling|naming) ", "call "),
    (r"^(the .+?) belongs to \w+[,;.]+ (?:and |so )?(?:it|that|this) is (?=(?:my|\w+'s|our)\b)", r"call \1 "),
    ("^this (?:here|room here|place here|one here) is ", "this is "),
    (r"\b(?:from now on|in future|in the future|henceforth|as of now)[,:]* (?=\w)", ""),
    ("[, ]+(?:from now on|in future|in the future|henceforth)(?=$|[.!])", ""),
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
    (r"\b(?:is|are) (?:now |also |actually |really |always )+(?=(?:the|my|our|called|\w+'s)\b)", "is "),
    (r"\bgoes by(?: the name(?: of)?)? ", "is called "),
    (
        ("^(?:i am called|call me|you (?:can|may|should) call me|people call me|they call me|my name(?: here)? is) "),
        "my name is ",
    ),
)
"""In the order in which they are tried."""
