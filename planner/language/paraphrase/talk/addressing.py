"""Words for the listener and for the moment: greetings, names for a robot, sighs, praise; they ask for nothing."""

from __future__ import annotations

_DEAR = (
    r"(?:love|luv|mate|matey|pal|dear|dearie|darling|sweetie|sweetheart|honey|hun|buddy|bud|bro|bruv|dude|chum|champ|"
    r"chief|boss|sunshine|treasure|angel)"
)
_CALLED = (
    r"(?:friend|fellow|chap|lad|lass|boy|girl|man|robot|bot|machine|butler|helper|servant|assistant|companion|thing|"
    r"one|star|hero|legend)"
)
_PRAISE = (
    r"(?:lovely|great|perfect|brilliant|wonderful|nice|super|awesome|excellent|fantastic|marvell?ous|splendid|superb|"
    r"terrific|fabulous|fab|bravo|amazing|cool|neat|sweet|ace|magic|smashing|top|well done|good|fine|grand|champion|"
    r"cheers|ta|hooray|wow|phew|great stuff|not bad|beautiful|delightful|ideal|spot on)"
)
_SIGH = (
    r"(?:oh|ah|ach|aw+|ooh|ugh|argh|gosh|god|goodness|jeez|gee|blimey|crikey|heavens|lord|oh dear|dear me|my goodness|"
    r"good (?:lord|grief|heavens)|for (?:god|heaven|goodness|pity|christ)(?:'s)? sakes?|damn|darn|bother|drat|"
    r"hmm+|mm+|tsk|whoops|oops|um+|uh+|uhm+|erm*|err+|pray|yeah|yep|yup)"
)

_PLEASE = (
    r"(?:please|pls|plz|kindly|thanks(?: a lot| so much| in advance)?|thank you(?: very much"
    r"| so much| kindly)?|thx|ta|cheers|many thanks|ok|okay)"
)

_YEAH = r"(?:yeah|yep|yup|cool|k|bye|kthxbye|alright|okey dokey|kk|innit|man|bro)"

ADDRESSING: tuple[tuple[str, str], ...] = (
    (
        (
            rf"(?<=\w)(?:[,.!]* (?:{_PLEASE}|{_YEAH}))*[,.!]* {_YEAH}(?:[,.!]* {_PLEASE})*(?=[.!]*$)"
            r"(?<!the man)(?<!a man)(?<!that man)"
        ),
        "",
    ),
    (
        (
            r"(?<=\w)(?<!\byou)(?<!\bhe)(?<!\bshe)(?<!\bthey)(?<!\bis)(?<!\bit)(?<!\beverything)"
            rf"(?:[,.!]* {_PLEASE})+(?=[.!?]*$)"
        ),
        "",
    ),
    (rf"^(?:{_PLEASE}[,.!]* )+(?=\w)(?!do\b)", ""),
    (r"\b(?:um+|uh+|uhm+|erm+|err+|er|hmm+|ach|pray|ugh|gosh|jeez|blimey)\b,? ?(?=\w)", ""),
    (rf"(^|[,.;!] |\b(?:but|and|or) ){_SIGH}[,!.]* (?=\w)(?!no\b)", r"\1"),
    (
        (
            r"^(?:hi|hey|hello|hiya|howdy|yo|greetings|hullo|good (?:morning|evening|afternoon|day"
            r"|night)|morning|evening)"
            r"(?: (?:there|again|you|everyone|robot|my \w+|majordomo|butler))*[,.!]* (?=\w)"
        ),
        "",
    ),
    (rf"(?<=\w),? (?<!\bthe )(?<!\bmy )(?<!\ba )(?<!\bto )(?<!\bfor ){_DEAR}(?=[.!?]*$|,)", ""),
    (rf"(?<=\w), (?:my |you |old |good |there'?s a )+(?:\w+ )??{_CALLED}(?=[.!?]*$|,)", ""),
    (
        (
            rf"^(?:my |you )?(?:dear |good |old |metal |little |trusty )*(?:{_DEAR}|robot|bot|butler"
            rf"|majordomo)[,!]+ (?=\w)"
        ),
        "",
    ),
    (
        (
            rf"^(?:that is |that was |how |very |really |so )?{_PRAISE}(?: (?:job|work|stuff|one|thanks"
            rf"|thank you|then))?[,.!]+ (?=\w)"
        ),
        "",
    ),
    (rf"(?<=\w)[,.!]+ (?:that would be |that is |would be )?{_PRAISE}(?:, thanks?(?: you)?)?(?=[.!]*$)", ""),
    (
        r"(?<=\w),? (?:chop chop|pronto|stat|on the double|double quick|sharpish|quick sticks|quick smart)(?=[.!]*$)",
        " asap",
    ),
)
"""In the order in which they are tried."""
