"""Ways of moving things that name no *put*: thrown away, cleared off, taken along, *into the bin with it*."""

from __future__ import annotations

_THING = (
    r"((?:it|them|that|this|those|these|everything|(?:the|my|his|her|our|all|every|both|any"
    r"|those|these|that|an?) [^,.;!?:]+?))"
)
_PREP = r"(into|in|onto|on|to|over to|down to|back to|next to|inside)"
_END = r"(?=$|[.,;!?]| and | then | after | before | when | if )"
_LEAD = r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen )|(?<=\bplease )|(?<=\byou )|(?<=\bto ))"

DISCARDING: tuple[tuple[str, str], ...] = (
    (
        (
            r"\b(?:swap|switch|exchange|change)(?: the)? (?:places|positions|spots|locations) (?:of|for)"
            r" ([^,.;]+?) (?:and"
            r"|with) (?=(?:the|my|his|her|\w+'s)\b)"
        ),
        r"swap \1 and ",
    ),
    (
        (
            r"^(?:please |can you )*clear(?: away| up)? (?:all )?(?:of )?the ((?:\w+ )?\w+s) (?:off|from|out of) "
            r"((?:the|my|our) [\w' ]+?) (onto|into|on to|to) (?=(?:the|my|our|that|an?)\b)"
        ),
        r"put all the \1 from \2 \3 ",
    ),
    (
        (
            r"^(?:can|could|may|should|must|would) ((?:the|my|our) [\w ]+?) (?:please )?be (?:cleared|emptied|tidied)"
            r"(?: off| out| up| please)*[?.,]+ (?:the|all the|its|all) (?:things|stuff|contents|items)(?: on it| in it"
            r"| there)? (?:can |should |may |could |must |all )*(?:go|goes|belong|be put) (in|on|into|onto|to) "
        ),
        r"put everything from \1 \2 ",
    ),
    (
        (
            r"\b(?:take|get|move|remove) ((?:the|my|those|these|that) [\w' ]+?) (?:away )?from ((?:the|my|\w+'s) "
            r"[\w' ]+?)(?:,|;| and"
            r")+ (?:then |please )*(?:put|place|bring|carry|take) (?:it|them) (?=(?:in|on|to|into|onto|next)\b)"
        ),
        r"put \1 from \2 ",
    ),
    (
        (
            r"^((?:the|my|this|that) [\w' ]+?) (?:is|are) not where (?:it|they) (?:should|ought to|must|belongs?|is "
            r"supposed to)"
            r"(?: be)?[:,;.!]+ (?:so |please )*(put|take|bring|carry|move|return) (?:it|them) "
        ),
        r"\2 \1 ",
    ),
    (
        r"\b((?:take|put|bring|carry) (?:the|my) [\w ]+?), then ((?:the|my) [\w ]+?), (?=(?:to|in|on|into|onto) )",
        r"\1 and \2 ",
    ),
    (
        (
            r"^(?:please )?(?:get rid of|away with|out with|throw out|throw away|dispose "
            r"of) ([^,.;!]+?)[,;.!]+ (?:[^.;!]*[.;!]+ )?"
            r"(?:in|into) ([^,.;!]+?) with (?:it|them)(?=[.!]*$)"
        ),
        r"put \1 in \2",
    ),
    (
        (
            rf"{_LEAD}(?:swap|exchange|switch|swop|trade)(?: round| around| over)? ((?:the|"
            rf"my|his|her|that|\w+'s) [^,.;]+?) (?:and|with|for|"
            r"against) ((?:the|my|his|her|that|\w+'s) [^,.;]+?)(?: (?:round|around|over|please|for me))*(?=$|[.,;!])"
        ),
        r"put \1 where \2 is, then put \2 where \1 was",
    ),
    (
        (
            r"^(?:let |make |have )?((?:the|my|his|her|that) [^,.;]+?) and ((?:the|my|his|"
            r"her|that) [^,.;]+?) (?:should |must |are to |can )?"
            r"(?:swap|change|switch|trade|exchange) (?:places|positions|spots)(?=[.!]*$)"
        ),
        r"put \1 where \2 is, then put \2 where \1 was",
    ),
    (rf"\b(?:throw|chuck|toss|fling|pitch) {_THING} (?:away|out){_END}(?! in)", r"put \1 in the trash can"),
    (rf"{_LEAD}(?:throw|chuck|toss|fling|pitch) (?:away|out) {_THING}{_END}", r"put \1 in the trash can"),
    (rf"{_LEAD}(?:bin|trash|dispose of|discard|junk) {_THING}{_END}", r"put \1 in the trash can"),
    (
        (
            rf"\b(?:clear|take|get|sweep|remove|gather|collect|grab|pick) (everything|it all|all(?: of)?"
            rf"(?: the)? [\w ]+?|the [\w ]+?) "
            rf"(?:up )?(?:off|from|out of|off of) ([^,.;]+?)(?:,| and|, and) (?:then )?(?:put|place|set"
            rf"|move|take|bring|stick|pop|lay|drop|carry|stow) "
            rf"(?:it|them|it all|them all|everything|all of it) {_PREP} "
        ),
        r"put \1 from \2 \3 ",
    ),
    (
        (
            rf"\b(?:clear|rid|empty|strip|relieve) (the [\w' ]+?) of (?:all )?(?:the |its |any )?"
            rf"([\w ]+?)[,;:.]+ (?:they|these|those|it|which)(?: all)? "
            rf"(?:go|goes|belong|belongs|should (?:go|be)|can go|need to go|want to go|are to go) {_PREP} "
        ),
        r"put all the \2 from \1 \3 ",
    ),
    (
        (
            rf"\b(?:clear|rid|empty|strip) (the [\w' ]+?) of (?:all )?(?:the |its |any )?([\w ]+?)(?:,"
            rf"| and|, and| by) (?:put|putting|place|placing|move|moving|take|taking|carry) "
            rf"(?:it|them|those|these) {_PREP} "
        ),
        r"put all the \2 from \1 \3 ",
    ),
    (
        (
            r"^(?:and |now |then |ok |okay |so |,)*(?:(?:off|over|straight|right|away|out|down|up) )*(back )?"
            r"(into|onto|to|over to|down to|back to) "
            r"((?:the|my|our|its|their|his|her|that|this|\w+'s|\w+) ?[\w' ]*?) with (it|them|that|those"
            r"|this|these|him|(?:the|my|his|her|all|both|every|that|those|this) [\w' ]+?)"
            r"(?:,? (?:then|please|now|you go|thanks))?(?=[.!]*$)"
        ),
        r"put \4 \1\2 \3",
    ),
    (
        (
            rf"^(?:and |now |then |ok |okay |so |,)*(back )?{_PREP} "
            r"((?:the|my|our|its|their|his|her|that|this|\w+'s) [\w' ]+?) with (it|them|that|those|this|these)"
            r"(?:,? (?:then|please|now|thanks))?(?=[.!]*$)"
        ),
        r"put \4 \1\2 \3",
    ),
    (
        (
            r"^(?:and |now |then |ok |okay |so |,)*(back (?:in|on) )"
            r"((?:the|my|our|its|their|his|her|that|this|\w+'s) [\w' ]+?) with ((?:the|my|his|her|that"
            r"|those|this) [\w' ]+?)"
            r"(?:,? (?:then|please|now|thanks))?(?=[.!]*$)"
        ),
        r"put \3 \1\2",
    ),
    (
        (
            r"\b(?:go|walk|run|drive|head|come|pop|nip|hurry)(?: over| back| up| down| across| along"
            r"| round)* (?:over )?to ([^,.;!?]+?) with "
            r"(it|them|that|those)(?=$|[.,;!?]| and | then )"
        ),
        r"take \2 to \1",
    ),
    (r"\b(?:drape|hang|spread|lay|throw|fold|sling|put|place) ([^,.;]+?) over (?=(?:the|my|that|a) )", r"put \1 on "),
    (
        (
            r"\b(?:hand|pass|give) (it|them|that|those|the [\w ]+?) (?:over|across|along|round)(?=$"
            r"|[.,;!?]| and | please)(?! to\b)"
        ),
        r"bring me \1",
    ),
    (
        (
            r"\b(bring|hand|pass|give|take|fetch|carry|send|get|run)( (?:it|them|that|those|me|him|her|"
            r"(?:the|my|his|an?|some|two|three) [^,.;!?]+?)) "
            r"(?:over|across|along|round|around|through|by|up|down)(?=$|[.,;!?]| and | then | for | when | if | will )"
        ),
        r"\1\2",
    ),
    (r"\b(?:hand|pass) over (it|them|that|the [\w ]+?)(?=$|[.,!?]| and )", r"bring me \1"),
    (r"\b(give|bring|hand|pass|get|fetch|show) (it|them|that|this|those) (me|us|him|her)\b", r"\1 \3 \2"),
    (r"\b(?:take|put|bring|carry|move) all of (it|them|that|those)\b", r"take \1"),
    (
        (
            r"\blet (the [\w ]+?|it|them) (?:live|stay|sit|stand|be|rest|go|lie|remain)(?: for now"
            r"| from now on| now)? (?=(?:on|in|at|next|by|under) )"
        ),
        r"put \1 ",
    ),
    (
        (
            r",? (?:in (?:return|exchange|turn)|for now|for the time being|for a change"
            r"|while you are about it)(?=$|[.,;!?])"
        ),
        "",
    ),
    (r"(,? and) for (\w+) ((?:the|an?|my|some) [\w ]+?)(?=[.!?]*$)", r"\1 \3 for \2"),
    (
        (
            r"(?<!is )(?<!called )(?<!as )(?<!room )\b(the|my|his|her|our|your|that|this) (?:dirty"
            r"|clean|nice|lovely|old|new|beautiful|silly|stupid|bloody|damn|damned|poor|"
            r"smelly|stinky|filthy|used|spare|very|actual|cute|pretty|ugly|precious|wretched|blasted"
            r"|fancy|good|trusty|usual|delicious|tasty|"
            r"juicy|ripe|fresh|yummy|worn|shabby|aforementioned|said) (?!\w+s\b)(?!\w+ \w+s\b)(?=\w)"
        ),
        r"\1 ",
    ),
    (
        (
            r"(?<=\w)[,.;]+ (?:please )?(?:sort (?:that|it|this) out|get (?:it|that) done|make it (?:so"
            r"|happen)|(?:please )?do (?:that|it)|that is your job|off you go|get (?:to it|on with it"
            r"|going)|hop to it|see to it|deal with (?:it|that))"
            r"(?: please| for me| will you| now)*(?=[.!]*$)"
        ),
        "",
    ),
    (
        (
            r"(?<=[.;!] )(?:so |and |now |then )*(into|onto|in|on|to) ((?:the|my|our|its|his|her|\w+'s) [\w' ]+?) with "
            r"(it|them|that|those|both)(?: now| please)*(?=[.!]*$)"
        ),
        r"put \3 \1 \2",
    ),
)
"""In the order in which they are tried."""
