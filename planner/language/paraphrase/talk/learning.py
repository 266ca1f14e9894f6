"""English of learners, and of the small ones: *me them glasses*, *is possible that you bring*, *how I go*."""

from __future__ import annotations

_DEED = r"(?:bring|take|put|go|get|fetch|give|come|carry|move|find|drop|return|look|hand|pick|place|pass|grab|drive)"
_COLOR = r"(?:red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|orange|gold|silver)"
_WHERE = r"(?=(?:in|on|at|inside|next to|by|near|under|with|beside)\b)"
_HUNGRY = r"(?:hungry|thirsty|tired|cold|sleepy|bored|sick|sad|hot|ill)"
_THING = r"(?:the|an?|my|this|that|his|her) [\w' ]+?"
_GIVING = r"(bring|give|carry|take|deliver|hand|pass|fetch)"

LEARNING: tuple[tuple[str, str], ...] = (
    (r"\bdo the needful(?: and| to)? (?=\w)", ""),
    (
        r"\b(i|we) (?:have|am in|are in|has|have got) (?:a |the )?(?:need|necessity|want) (?:of|for|to have) ",
        r"\1 need ",
    ),
    (
        (
            rf"\b((?:can|could|will|would|must) you|you must|please) (?:to )?(me|us|him|her) ({_THING}) "
            rf"(?:to )?{_GIVING}(?=[?.!]*$)"
        ),
        r"\1 \4 \2 \3",
    ),
    (rf"^(?:please )?(to (?!me\b)\w+(?: \w+)?),? ({_THING}) (?:please )?{_GIVING}(?=[?.!]*$)", r"\3 \2 \1"),
    (
        (
            rf"\b(?:make|do)(?: it)?(?: so)? that ({_THING}) (?:is coming|comes|come|is going|goes|go|gets"
            rf"|is brought|arrives) to (?=\w)"
        ),
        r"bring \1 to ",
    ),
    (
        rf"^it (?:must|has to|needs?|should|is necessary)(?: be)? ({_THING}) (?=(?:to|in|on|at|into|onto)\b)",
        r"\1 should go ",
    ),
    (
        (
            r"^((?:the|this|that|these|those|my) [\w' ]+?),? (?:is|are) for ((?!me\b)[\w' ]+?),? (?:and "
            r"|so |then )?(?:you |please |you must |must )*"
            r"(?:bring|give|carry|take|deliver|hand|pass)(?: it| them)?(?: to (?:him|her|them))?(?: please)?(?=[.!]*$)"
        ),
        r"bring \1 to \2",
    ),
    (r"^(?:please,? )?((?:the|this|that|my) [\w' ]+?),? for (\w+) (?:it )?(?:is|are)(?=[.!]*$)", r"bring \1 to \2"),
    (rf"^(?:me |i |i is |me is |we ){_HUNGRY}[,.!;]* (?=\w)", ""),
    (r"\bout(?:t)?a (?=(?:the|my|his|her)\b)", "out of "),
    (rf"\b({_DEED}) 2 (?=(?:me|us|him|her)\b)", r"\1 to "),
    (rf"\b({_DEED}(?: me| us| him| her)?) them (?=\w+s\b)(?!this|his)", r"\1 those "),
    (r"\b(can|could|may) (i|we) (?:haz|has|hav|hazz)\b", r"\1 \2 have"),
    (r"^(?:want|wants|need|needs) (?!to\b|you\b|some(?:one|body)\b)(?=\w)", "i want "),
    (rf"\b(?:the|my|that) (\w+) the ({_COLOR}|big|small|little|large) one\b", r"the \2 \1"),
    (rf"\b(?:i|we) (?:want|need|would like|wish|like) you (?=(?:please )?{_DEED}\b)", ""),
    (r"\b(can|could|would|will|must|should|may|might) you to (?=\w)", r"\1 you "),
    (r"^you (?:can|could|must|should) to (?=\w)", "you can "),
    (
        (
            r"^(?:is it|it is|is|would it be|would be|it would be|it will be) possible (?:for (?:me|us) )?(?:to|that "
            r"(?:i|we)) (?:have|get) (?!(?:in|into|to|inside|through|out|there)\b)"
        ),
        "can i have ",
    ),
    (
        (
            rf"^(?:is it|it is|is|would it be|would be) possible (?:that|if) you (?:can |could |will "
            rf")?(?={_DEED}\b)"
        ),
        "can you ",
    ),
    (
        (
            rf"^(?:please )?(?:have|do me) the (?:kindness|goodness|courtesy|favou?r|pleasure) (?:to|of|and) "
            rf"(?={_DEED}\w*\b)"
        ),
        "",
    ),
    (
        (
            rf"^(?:please )?(?:make|do)(?: to)? me (?:the|a|this) (?:favou?r|kindness|pleasure) (?:to|of|and) "
            rf"(?={_DEED}\b)"
        ),
        "",
    ),
    (
        (
            r"^(?:the )?(\w+(?: \w+)?) (to (?:me|us|him|her|(?!the\b)\w+)) (?:please )?(bring|give|carry|take"
            r"|deliver)(?: please)?(?=[.!]*$)"
        ),
        r"\3 the \1 \2",
    ),
    (r"\b(i|we) would (?:need|want|require)\b", r"\1 need"),
    (
        (
            rf"\b({_DEED}(?: me| us| him| her)? (?!(?:me|us|him|her)\b)[\w ]+?) (?:who|what|whose|whom|wich|witch"
            rf"|where) (is|are) {_WHERE}"
        ),
        r"\1 that \2 ",
    ),
    (r"\b(go|drive|walk|come|move) (?:up )?(?:until|till|til) (?=(?:the|my|our|room|\w+[.!]*$))", r"\1 to "),
    (r"^(where|who|what) (?:it|he|she|they) (is|are) (?=(?:the|my|our|in|on|at|a|an)\b)", r"\1 \2 "),
    (r"^(who|what) (is|are) (?:it|there it) (?=(?:in|on|at|under|next|near)\b)", r"\1 \2 "),
    (r"^(where|who|what) (is|are) (?:being|been|be) (?=\w)", r"\1 \2 "),
    (r"^there (?:is|are) (how many [^?]+?)(?: there)?(?=[?.!]*$)", r"\1"),
    (
        (
            r"^how (?:many|much) ([\w ]+?)(?<! do)(?<! did)(?<! can)(?<! could)(?<! have)(?<! has) (?:we|i|you"
            r"|they) (?:have|has|got"
            r"|own|possess)((?: (?:here|in total|now|left))?"
            r"|(?: (?:in|on|at) [^?]+?))(?=[?.!]*$)"
        ),
        r"how many \1 are there\2",
    ),
    (
        (
            r"^(in|on|at) ([\w' ]+?),? how many ([\w ]+?)(?: (?:are there|there are|are|is there|do you "
            r"see))?(?=[?.!]*$)"
        ),
        r"how many \3 are \1 \2",
    ),
    (r"^(?:of|in) (?:which|what) colou?r (is|are) ", r"what color \1 "),
    (
        (
            r"\b((?:take|get|fetch|pick up|grab|find) (?:the|my|an?|that) [\w ]+?,? (?:and |then )+(?:please )?"
            r"(?:bring|take|put|give|carry|place|drop|move)) (?:him|her) (?=(?:to|on|in|into|onto|at|next)\b)"
        ),
        r"\1 it ",
    ),
    (r"^(the (?:\w+ )?\w+),? (?:he|she) (?=(?:should|must|has to|have to|needs to|goes|belongs|shall)\b)", r"\1 "),
    (
        (
            r"^(?:i|we) (?:am |are )?(?:look|looking|search|searching|seek|seeking)(?: for| after)? (?=(?:the|my|our"
            r"|an?)\b)"
        ),
        "i am looking for ",
    ),
    (
        (
            r"^how (?:(?:do|can|could|shall|should|may) )?(?:i|we) (?:must |can |should |do )?(?:arrive|come|go"
            r"|get|reach|walk|drive)"
            r"(?: (?:to|in|at|into))? (?=(?:the|my|our|\w+[?.]*$))"
        ),
        "how do i get to ",
    ),
    (r"^stop(?: please)? to (?:move|drive|go|run)\b", "stop moving"),
    (
        (
            rf"\b({_DEED}(?: me| him| her| us)?) (?!(?:the|an?|my|some|it|them|that|to|for|his|her|all|both|every|any"
            rf"|one|and|or|not|something|anything|nothing|everything|me|him|her|us|somebody)\b)"
            rf"(\w+) ({_COLOR})(?=[.,!?]*$| (?:to|on|in|for|from|at|into|onto)\b)"
        ),
        r"\1 the \3 \2",
    ),
)
"""Before the rules of ``FOREIGN``."""
