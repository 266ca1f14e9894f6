"""One wording for many: sentence frames and set phrases are rewritten before words are told apart.

The rules work on lower-case text with contractions written out. Each says the same in words that the grammar knows.
"""

from __future__ import annotations

import re

_THEY = r"(?:you|we|i|it|they|she|he|that|this|those)"
_PLACED = (
    r"(?:got|get|found|find|took|taken|take|picked|grabbed|fetched|retrieved|came|come|comes|been|stood|lay|sat|was"
    r"|were|brought|removed|moved|belongs?|belonged|goes|go|used to be|had been|lived?|lives)"
)
_SPOT = r"(?:place|spot|position|location|home|whereabouts)"
_OLD = (
    r"(?:old|original|previous|former|usual|proper|right|rightful|own|initial|first|earlier|normal|prior|same|"
    r"correct)"
)
_ADDED = r"(?: before| originally| earlier| at first| initially| in the first place| again| previously)?"
_RESTORING = r"\b(?:put|return|take|bring|carry|move|place|set|leave|drop|get|give|restore|go)\w*\b"

_ORIGIN = (
    (
        rf"(?:back )?(?:(?:to|in|into|at|on|from) )?(?:exactly |right |just )?(?:(?:the|its|their) )?(?:{_OLD} )?"
        rf"(?:{_SPOT} )?(?:from where|where|wherever|from which)"
        rf" {_THEY}(?: originally| first| just)?(?: had| have| has)?"
        rf" {_PLACED}(?: it| them| that| this| those)?(?: up)?(?: from)?{_ADDED}"
    ),
    (
        rf"(?:back )?(?:to|in|into|on|at) the {_SPOT} (?:that |which |where )?{_THEY}(?: had| have)? {_PLACED}"
        rf"(?: it| them| that)?(?: up)?(?: from| in| at| on)?{_ADDED}"
    ),
    (
        rf"(?:back )?(?:to|in|into|on|at) (?:its|their|the|his|her|it is) (?:{_OLD},? )*{_SPOT}{_ADDED}"
        r"(?! (?:of|where|in|on|at)\b)"
    ),
    rf"back (?:to|in|into|on|onto) (?:the|its|their) [\w ]{{2,40}}? where {_THEY} (?:was|were|came from){_ADDED}",
)
_BACK = re.compile(rf"({_RESTORING}[^.;?!]*?) (?:{'|'.join(_ORIGIN)})(?=$|[\s.,;!?])")

_RULES: tuple[tuple[str, str], ...] = (
    # spelling
    (r"\b(?:teh|hte|th)\b", "the"),
    (r"\b(?:adn|nad|n)\b(?= )", "and"),
    (r"\bgoto\b", "go to"),
    (r"\b(?:form)\b(?= the\b)", "from"),
    (r"\b(go|goes|come|drive|head|back|walk|move) (?:too|ot|2)(?= )", r"\1 to"),
    (r"\b(?:u+m+|e+r+m+|u+h+m*|h+m+|pleas|plase|pleese|pls+|plz+|plox|thx|tnx|thanx)\b(?=.)", "please"),
    (r"\byuo\b", "you"),
    (r"^(?:wher|whre|were)(?= (?:is|are)\b)", "where"),
    (r"\b(?:fo|4|fro)(?= (?:me|you|her|him)\b)", "for"),
    (r"\bhw many\b", "how many"),
    # courtesy and motives
    ((r"^(?:so,? )?(?:i was (?:just )?(?:thinking|wondering|hoping)|i have been thinking)[,.]* (?=it|can|could|"
     r"would)"), ""),
    ((r"^(?:i am|we are|he is|she is) (?:so |really |very |a bit |a little |quite |feeling )*(?:thirsty|hungry|"
     r"cold|tired"
     r"|bored|busy|sick|late|hot|in a hurry|starving|freezing)[,.!;:]*(?: and| so)? (?=\w)"), ""),
    ((r",? (?:because|cause|cuz) (?:i|we|he|she|it|they|my|the \w+|\w+) (?:am|is|are|was|have|has|need|needs"
     r"|want|wants|would|will|can not|feel|feels|forgot)\b[^.;!?]*(?=$|[.;!?])"), ""),
    ((r",? so (?:that )?(?:i|we|he|she|they|it) (?:can|could|will|may|do not|does not|is|are|am)\b[^.;!?]*(?=$|[."
     r";!?])"), ""),
    ((r"^(?:hey|hi|ok|okay|oh|well|so|and|now|right|alright|listen|hello|yo|good|great|thanks|thank you|cool|"
     r"perfect)"
     r"[,!.]+ "), ""),
    (r"^i(?: would|) (?:need|want|like|love|prefer)(?: for)? you to ", ""),
    (r"\b(?:for|to) the (?:moment|time being)\b", ""),
    # taking back, in a word
    (r"^(?:please )?(?:undo|reverse|revert) (?:that|it|this|the last (?:one|step|thing|move|task))[.! ]*$",
     "put it back where it was"),
    ((r"^(?:please )?(?:never mind|nevermind|forget it|stop|wait|no)[,.;:!]+ (?=(?:put|take|return|bring) (?:it|"
     r"them|that|the \w+) back\b)"), ""),
    (r"^(?:please )?(?:never mind|nevermind|forget it)[,.;:]* (?=(?:put|take|return|bring)\b)", ""),
    ((r"\b(?:i|you|we|he|she|they|someone|somebody) (?:have |had |just )*(?:left|put|placed|dropped|forgot|laid|"
     r"set|saw)"
     r"(?: lying| standing| down)? (?=(?:on|in|at|next|by|near) )"), "that is "),
    # bringing
    (r"\bshow (?=(?:me|him|her|anna|ben|\w+) the \w+ and (?:then )?(?:return|put|bring))", "bring "),
    ((r"\bthrow (.+?) (?:away )?(in|into|in to) (?=(?:the |a |my )?(?:\w+ )?(?:trash|bin|garbage|rubbish|waste|"
     r"dustbin))"),
     r"put \1 in "),
    (r"\b(?:toss|chuck|dump|sling|bin) (.+?) (in|into|onto|on) (?=(?:the|a|my)\b)", r"put \1 \2 "),
    ((r"\b(put|set|place|lay|stow|store|tidy|clear|pack|drop|move|take) (.+?) away (?=(?:in|into|on|onto|to)\b"
     r")"), r"\1 \2 "),
    (r"\b(?:put|tidy|clear|pack|stow) away (.+?) (?=(?:in|into|on|onto)\b)", r"put \1 "),
    (r"\b(put|set|lay) (?=(?:on|onto|in|into|next to) (?:the |a |my )?\w+(?: \w+){0,4}[.!]*$)", r"\1 it "),
    (r"\b(bring|take|carry|drop) (?=to (?:me|him|her|(?:the|my) \w+(?: \w+)?)[.!]*$)", r"\1 it "),
    (r"\b(?:is|are) to (?:be|go|stay|stand|come|end up) (?=(?:in|on|at|to|into|onto|next)\b)", "should be "),
    ((r"\b(?:should|must|needs? to|ought to|has to|have to|is supposed to|are supposed to) (?:be )?(?:put|placed|"
     r"moved|taken"
     r"|brought|delivered|carried|stored|kept|returned|transferred) "), "should go "),
    (r"\b(?:should|must|needs? to|ought to|has to|have to) (?:live|stand|sit|lie|end up|belong) ", "should be "),
    (r"\b(?:wants? to be|want) (?=(?:on|in|onto|into) the\b)", "should be "),
    (r"\b(\w+ (?:is|are)) to (?:be )?(?:put|placed|moved|brought|taken) ", r"\1 to go "),
    (r"\b(?:belongs?|goes) (?=(?:on|in|at|with|inside|next|into|onto|back)\b)", "should be "),
    (r"\b(?!lets\b|thanks\b|always\b|us\b)(\w+s) (?:can |may |will )?go (?=(?:on|in|into|onto|next)\b)", (r"\1 "
     r"should be ")),
    (r"\bgoes (?=to (?:me|him|her|the|\w+)\b)", "should be "),
    (r"(?<!if )\b(\w+) (?:should|must|may|can|shall) (?:have|get) (it|them|that|the [\w ]+)(?=$|[.!?,])", (r"give"
     r" \2 to \1")),
    (r"\b(?:i want(?:ed)? )?(it|them|that|this) to (?:go|be) (?=to )", r"put \1 "),
    (r"\b(?:i want(?:ed)? )(it|them|that|this) to (?:go|be) ", r"put \1 "),
    (r"^(all|every|both|the \w+s) ([\w ]*?)(?<!\bgo )(into|onto) (?=(?:the|a|my)\b)", r"put \1 \2\3 "),
    (r"\bto (?:the|his|her|my) (?=where)", ""),
    (r"\blet(?: us)? (?=(?:the|my|all|every)\b[^.]* (?:go|be) )", "ensure "),
    ((r"\b(?:the rest|everything else|all else|the others?) (?:can |may |should )?(?:stays?|remains?)"
     r"(?: (?:where|there|put|as|here)[^.,;]*)?"), ""),
    (r"\bcould i (?:trouble|bother) you for\b", "can i have"),
    (r"\b(?:i am|we are) (?:dying|longing) for\b", "i want"),
    (r"\bgo(?: and)? (?:bring|get|fetch) \b", "fetch "),
    (r"\b(?:over )?to where i am(?: now| standing| sitting)?\b", "to me"),
    (r"\b(?:back )?to where you (?:were|started|came from|came)(?: from)?(?: before| at)?\b", "back"),
    (r"^(?:and |ok |okay |then |now )*(?:and )?then (?=\w)", "then "),
    (r",? from there (?=(?:to|go|on|drive|head)\b)", ", then "),
    (r"\b(?:after|having done|once done with) that\b,?", "then"),
    (r"\b(should|must|can|may) all (?=(?:be|go)\b)", r"\1 "),
    (r"^(\w+s) (to|into|onto) (?=(?:the|a|my)\b)", r"put all the \1 \2 "),
    (r"^(?:please )?(?:gather|round|collect)(?: up)? (.+?) and (?=(?:put|bring|take|carry)\b)", r"pick up \1 and "),
    (r"\bback again\b", "back"),
    (r"\b(put|take|bring|return|move) (?:everything|it all|all of it|all of them|all that) back\b", (r"\1 them "
     r"back")),
    ((r"^(?:i|we) (?:do not|no longer) need (?:\w+ ){1,4}?(?:any ?more|any longer|now)[,.;!]+ (?:so )?(?:please )"
     r"?"), ""),
    (r"^(?:i|we) (?:am|are) (?:done|finished|through)(?: with [\w ]+?)?[,.;!]+ (?:so )?", ""),
    ((r"^(?:do not \w+ (?:me )?|not )(?:the |a )(?:\w+ )?(\w+)[,;]+ (?:but |just |instead )*(?=(?:bring|take|put|"
     r"go|fetch|get|carry"
     r"|move|give)\b)(.*)\bone\b"), r"\2\1"),
    (r"^not (?:the |a |to the )[\w ]+?[,;] (?:but )?(?=(?:bring|take|put|go|fetch|get|carry|move|give)\b)", ""),
    (r"\bthat is not an? (\w+)(?=$|[.!?,])(?<! one)", r"except \1s"),
    (r",? but (?:no|not an?|not the) (\w+?)(?: ones?)?(?=$|[.!?])", r" that is not \1"),
    (r"\b(?:something|anything) (red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|orange)\b", (r"a "
     r"\1 thing")),
    (r"\bout of (the [\w ]+?) and (?:in)?to\b", r"from \1 to"),
    (r"^(?:could|can|may) (the [\w ]+?) be (?:moved|put|brought|taken|placed|delivered|carried) ", r"put \1 "),
    (r"^(?:please )?(?:have|get) (the [\w ]+?) (?:brought|taken|moved|delivered|carried|put|placed) ", r"put \1 "),
    (r"^(?:please )?(?:get|take|grab|fetch|pick up) (the [\w ]+?)[,;] (?:it|they|that) should be ", r"put \1 "),
    (r"\b(bring|give|get|fetch|take)me\b", r"\1 me"),
    (r"\b(?:quickest|fastest|shortest|best|easiest) (?:route|path|way)\b", "way"),
    (r"^what (\w+) (?:do|have) (?:we|you|i) (?:have|got)(?=$|[.!?])", r"which \1 are there"),
    ((r"^(?:is|are) (.+?) (?:in|on|at) (?:the |a |my )[\w ]+? or (?:in |on |at )?(?:the |a |my )?[\w ]+?(?=$|[.!?"
     r"])"), r"where is \1"),
    (r",? (?:but |and )?only (?:the |an? )?(\w+) ones?(?=$|[.!?])", r" that is \1"),
    ((r"^((?:the|my|that) [\w ]+?), (?:can you |could you |please )*(bring|take|put|get|fetch|carry) (?:it|them)"
     r" "), r"\2 \1 "),
    ((r"^(?:i|we) do not (?:want|need) [\w ]+?[,.;]+ (?:just |but |so |please )*(?=(?:bring|take|put|get|fetch|"
     r"give)\b)"), ""),
    (r"^do not (\w+)( me)? the (?:\w+ )?(\w+),? but (?:rather |instead )?the (\w+) one(?=$|[.!])", (r"\1\2 the \4"
     r" \3")),
    (r"^on (?:the|your) way to ([\w ]+?), (.+)$", r"\2, then go to \1"),
    (r",? on (?:the|your) way to ([\w ]+)(?=$|[.!])", r", then go to \1"),
    ((r"^(?:while|when|if) you are (?:over )?(?:in|at) ([\w ]+?), (?=(?:bring|take|get|fetch|pick|put|grab)\b"
     r")"), r"go to \1, then "),
    (r"\b(?:meet|join|wait for) (?:me|us) (?=(?:in|at)\b)", "go "),
    (r"\b(?:the|all the|all) stuff (?=(?:on|in|from|at)\b)", "everything "),
    ((r"^(?:i|we) (?:forgot|left|need|lost|want|misplaced) (my|the|our) ([\w ]+?)[,.;]+ (?:can|could|will|would)?"
     r" ?(?:you )?(?:please )?"
     r"(?:bring|get|fetch|grab) (?:me )?(?:it|them)(?: to me| for me)?(?: please)?(?=$|[.!?])"), r"bring me \1 \2"),
    ((r"^(?:get rid of|deal with|take care of) (the [\w ]+?)[,;.:] (?:please )?(?:put|take|throw|drop) (?:it|them"
     r") "), r"put \1 "),
    # comparing and choosing
    (r",? (?:anything|any color|whatever|everything|all) but (?:the |a )?(\w+)(?: ones?)?(?=$|[.!?,])", (r" that "
     r"is not \1")),
    (r",?(?: and| but| just| only)* not (?:a |the |an |any )(\w+)(?: ones?| colou?red one)(?=$|[.!?])", (r" that "
     r"is not \1")),
    (r"\breddish\b", "red"),
    (r"\b(green|brown|yellow|pink|gray|grey|black|orange)ish\b", r"\1"),
    (r"\bblu(?:e)?ish\b", "blue"),
    (r"\b(nearest|closest|farthest|furthest)( one)?(?: to (?:you|here|us)| from (?:here|you|us))", r"\1"),
    (r"\b(\w+)(?: that is| which is)? (nearest|closest|farthest|furthest)(?=$|[.!?,])", r"\2 \1"),
    ((r"(?:, it is|, which is|, that is|, i mean) the (biggest|largest|smallest|nearest|closest|tallest) (?:one|"
     r"of them)?"),
     r", the \1 one"),
    ((r"\b(?:somewhere|anywhere|around here|in this (?:house|home|building|school|office|hospital|flat|apartment|"
     r"place)|in the"
     r" (?:house|home|building|school|hospital|flat|apartment)|at all|lying around|around)(?=$|[.!?])"), ""),
    (r"\b(are there|is there|do we have|have we got|do you have|have you got) (any|some|a) (.+?) left\b", (r"\1 "
     r"\2 \3")),
    (r"^how many (.+?) are\s*[?]*$", r"how many \1 are there"),
    (r" from the (?:left|right)(?=$|[.!?])", ""),
    (r"\b(in|into|on|onto|at|near|to) the (nearest|closest) (\w+) to (?=the\b)", r"\1 the \3 nearest to "),
    (r"\b((?:in|into|on|onto|at|from|next to) (?:the|a|that) \w+(?: \w+)?) there(?=$|[.!?,])", r"\1 over there"),
    (r"^(the|a|an|some|my|two|three|one|both|that) ([\w ]+?),? please[.!]*$", r"bring me \1 \2"),
    # teaching
    ((r"^(?:just so you know|for your information|fyi|remember this|note this|learn this|please note|by the way|"
     r"btw|listen)"
     r"[,.:;]* "), ""),
    (r"\b(?:from now on|in future|in the future|henceforth|as of now)[,:]* (?=\w)", ""),
    (r"[, ]+(?:from now on|in future|in the future|henceforth)(?=$|[.!])", ""),
    (r"^(?:please )?(?:remember|note|know|keep in mind|learn|be aware|memorize|do not forget)(?: that|:|,)+ ", ""),
    (r"^you are (?:now )?in (?=(?:the|my) [\w ]+$)", "this room is "),
    ((r"^(?:this room|the room (?:we|you) are in|where (?:we|you) are(?: now)?|this place|the room you are in now) "
     r"(?:should be|will be|shall be|is) (?:known as|called|named) "), "this room is called "),
    ((r"^(?:let us|we|i|people|they|everyone|everybody|you (?:can|should|may|must))(?: all)?(?: will| always)? "
     r"(?:call|name|refer to) (.+?)(?: as)? (the|my|our|\w+'s) "), r"call \1 \2 "),
    (r"^(?:please )?(?:name|title|label|refer to|treat|think of|regard|know|remember|learn) (.+?) as ", (r"call "
     r"\1 ")),
    (r"^(?:please )?name (?=(?:this|that|the|it)\b)", "call "),
    (r"^(?:the |this )?(.+?)'s name is ", r"\1 is called "),
    (r"^(?:the )?name of (.+?) is ", r"\1 is called "),
    (r"\b(?:should|shall|will|is to|must|can) be (?:called|named|known as) ", "is called "),
    (r"\b(?:is|are) (?:now |also |actually |really |always )+(?=(?:the|my|our|called|\w+'s)\b)", "is "),
    (r"\bgoes by(?: the name(?: of)?)? ", "is called "),
    (r"^(?:i am called|call me|you (?:can|may|should) call me|people call me|they call me|my name(?: here)? is) ",
     "my name is "),
    # questions
    ((r"^(?:any (?:idea|clue)|do you have (?:any idea|a clue)|i (?:forgot|wonder|need to know|have forgotten|have"
     r" no idea)"
     r"|can you (?:tell me|say|remember|check)|could you (?:tell me|say|check)|please tell me|do you (?:happen "
     r"to )?(?:know"
     r"|remember))(?: about)? (?=(?:where|what|which|who|how|if|whether)\b)"), "tell me "),
    ((r"^where (?:did|have) (?:i|we|you|he|she|they|\w+) (?:last |just )?(?:leave|left|put|place|placed|drop|"
     r"dropped|lay|store"
     r"|stored|hide|hidden|set down|keep|kept)(?: down)? "), "where is "),
    ((r"^where (?:could|might|may|can|should|would) (.+?) (?:be|have gone|have got to|be found)(?: found)?"
     r"(?: now)?(?=$|[.!?])"), r"where is \1"),
    (r"^where (?:do|does|did) (.+?) (?:live|stand|go|belong|stay|lie|hang out)(?=$|[.!?])", r"where is \1"),
    (r"^where (?:has|have) (.+?) (?:gone|got to|ended up|disappeared(?: to)?|gotten to)(?=$|[.!?])", (r"where is "
     r"\1")),
    (r"^where(?: on earth| in the world| exactly| the hell|abouts) ", "where "),
    ((r"^(?:what|which) (?:shelf|table|desk|surface|place|furniture|spot|part of the (?:house|building)) (?:is|"
     r"are) (.+?) "
     r"(?:on|in|at)(?=$|[.!?])"), r"where is \1"),
    (r"(?<=\w) (?:lately|recently|by any chance)(?=$|[.!?])", ""),
    ((r"^(?:have|has|did) (?:anyone|anybody) (?:see|seen|spot|spotted|come across|noticed?)(?: where)? (.+?)"
     r"(?: is| are| lately| recently| today)?(?=$|[.!?])"), r"where is \1"),
    ((r"^(?:i|we) (?:can not|could not|do not|am unable to|are unable to) (?:find|see|locate|seem to find) "
     r"(.+?)(?: anywhere)?(?:[,.;] (?:do you know where (?:it|they) (?:is|are)|where (?:is|are) (?:it|they)|help)|)"
     r"(?=$|[?!.]$)"), r"where is \1"),
    ((r"^(?:what|which) (?:things?|stuff|items?|objects?) (?:is|are|do you see|can you see|lies?|stands?|can i "
     r"find)(?: there)? "
     r"(?=(?:in|on|at|next|under|behind|inside)\b)"), "what is "),
    ((r"^what(?: all)? (?:do (?:we|you|i) have|have (?:we|you) got|can (?:you|i) (?:find|see|get)|do you see|lies"
     r"|stands|sits"
     r"|can be found|is there|are there|is kept|is stored)(?: there)? (?=(?:in|on|at|next|inside)\b)"), "what is "),
    (r"^what does (.+?) (?:contain|hold|have in it)(?=$|[.!?])", r"what is in \1"),
    (r"^what is (?=(?:lying|standing|sitting|stored|kept) (?:in|on)\b)", "what is "),
    (r"^what(?: kind of| sort of)? color (?:does|do) (.+?) have\b", r"what color is \1"),
    (r"^(?:which|what) color has ", "what color is "),
    (r"^what is the color of ", "what color is "),
    (r"^tell me the color of ", "what color is "),
    ((r"^(?:how much|what (?:number|amount|quantity) of|what is the (?:number|amount|total) of|tell me how many|"
     r"the number of) ")
     , "how many "),
    (r"^(?:please )?count (?:up )?(?=(?:the|all|my|our)\b)", "how many "),
    (r"^how many (?:the|all the|of the|all|my|our) ", "how many "),
    ((r"^how many (.+?) (?:do|can|did|have) (?:we|you|i) (?:have|see|got|own|find|count)(?: here| now| left)?(?=$"
     r"|[.!?]| (?:in|on)\b)"),
     r"how many \1 are there"),
    (r"^how many (.+?) (?:does|do) (the .+?|\w+) (?:have|contain|hold)(?=$|[.!?])", r"how many \1 are in \2"),
    (r"^how many (.+?) (?:exist|remain|are left|are around|are here|are there here)(?=$|[.!?])", (r"how many \1 "
     r"are there")),
    (r"^(?:do|have) (?:we|i|you) (?:still )?(?:have|got|own)(?: got)? ", "is there "),
    (r"^(?:has|does) (?:the .+? )(?=have)", "is there "),
    (r"^(?:are|is) (.+?) (?:available|around|left|present)(?=$|[.!?])", r"is there \1"),
    (r"^is there (?:anything|something) (?:to (?:eat|nibble)|edible)\b", "is there food"),
    (r"^is there (?:anything|something) to drink\b", "is there a drink"),
    (r"\b(?:something|anything) to drink\b", "a drink"),
    (r"\b(?:something|anything|some food) to (?:eat|nibble|snack on)\b", "a snack"),
    (r"\b(?:something|anything) to write with\b", "a pen"),
    (r"\b(?:something|anything) to read\b", "a book"),
    (r"^who is (?:there )?(?:currently )?(?:staying |sitting |standing |working )?(?=in\b)", "who is "),
    (r"^is (?:anyone|anybody|someone|somebody) (?=(?:in|at)\b)", "who is "),
    (r"^(?:is|are) there (?:anyone|anybody|someone|somebody|people|any people) (?=in\b)", "who is "),
    (r"^(?:what|which) (?:people|persons) are (?:there )?(?=in\b)", "who is "),
    (r"^what (?:place|room) are (?:we|you) in(?: now| right now| currently)?", "where are you"),
    (r"^(?:where|in which room|which room) are we(?: now| at| in)?(?=$|[.!?])", "where are you"),
    (r"^(?:what is )?your (?:current )?(?:location|position|whereabouts)(?=$|[.!?])", "where are you"),
    (r"^(?:tell me )?where you are(?: now| right now| at)?(?=$|[.!?])", "where are you"),
    (r"^where are you (?:now|right now|currently|at|at the moment|standing|located)(?=$|[.!?])", "where are you"),
    ((r"^(?:what|is there anything) (?:do you have |have you got |is |are you (?:carrying|holding) )?in your (?:h"
     r"ands?|grippers?|arms?)"
     r"(?: right now| now)?"), "what are you holding"),
    ((r"^(?:are you (?:carrying|holding) (?:something|anything)|do you (?:carry|hold) anything|what do you (?:hol"
     r"d|carry)"
     r"|is your (?:hand|gripper) (?:empty|free|full))(?: right now| now| at the moment)?"), "what are you holding"),
    ((r"^(?:what|which) (?:things|tasks|jobs|kind of things|sort of things|commands?|requests?) (?:can|could) you"
     r" (?:do|handle"
     r"|understand|perform|follow)"), "what can you do"),
    ((r"^(?:what are you (?:able|capable)(?: to do| of doing| of)|what are your (?:abilities|skills|capabilities|"
     r"functions)"
     r"|how can you help(?: me)?|what do you do|what are you good (?:at|for)|how do you work|what can i ask you("
     r"?: to do)?)"
     r"(?=$|[.!?])"), "what can you do"),
    (r"^how (?:do|can|would|could|does one) (?:i|we|you|one)?\s?(?:get|go|come|walk|drive) from (.+?) to ",
     r"what is the way from \1 to "),
    (r"\bfrom (?:here|where i am) to\b", "to"),
    (r"^what is the way (?=to\b)", "how do i get "),
    ((r"^(?:what|where) (?:did|have) you (?:get|got|found|find|took|take|fetch(?:ed)?) (?:it|that|this|them) "
     r"from"), "what did you do"),
    ((r"^(?:what (?:did|have) you (?:just |last )*(?:do|done|move|moved|bring|brought)(?: just now| last| before|"
     r" so far| today)?"
     r"|what was (?:that|your last (?:task|action|job))|tell me what you (?:just )?did)(?=$|[.!?]"
     r")"), "what did you do"),
    (r"^(?:which way|how far away|how far) is it to\b", "how far is it to"),
    (r"^how (?:far|long) is (?:it|the way) (?:from here )?to\b", "how far is it to"),
    (r"^(?:is|are) there more (.+?) (?:or more|or|than) (.+)", r"are there more \1 than \2"),
    # finding
    (r"^(?:go )?(?:and )?see if (?:you can|you are able to) (?:find|locate|spot) ", "find "),
    ((r"^(?:find out|see|check|figure out|work out|look up|tell me) where (.+?) (?:is|are)(?: at| now)?(?=$|[.!?]"
     r")"), r"where is \1"),
    (r"^(find|locate|look for|search for) (.+?) (?:for me|for us)(?=$|[.!?])", r"\1 \2"),
    ((r"^where is (.+?)\? (?:please )?(?:go|and go|then)? ?(?:and )?(?:look for|find|search for|get|fetch) (?:it|"
     r"them|her|him)(?=$|[.!?])"),
     r"find \1"),
    (r"\b(?:find|locate|look for|search for) (?:me|us) (?=(?:the|a|my|some)\b)", "find "),
    # going
    (r"^(?:i|we) (?:need|want|would like) you (?:over |to be |to come )?(?=(?:in|at|by|near|next to)\b)", "go "),
    (r"\b(?:be|get yourself|show up|turn up|report) (?=(?:in|at|by) the\b)", "go "),
    (r"\b(?:go|drive|head|move) (?:back )?home\b", "come back"),
    ((r"\b(?:and|then) (?:get|come|head|drive|go|walk|run|be) back(?: here| again| to (?:me|us)| afterwards)*(?=$"
     r"|[.!?,])"),
     "then come back"),
    (r"\b(?:and|then) back(?: again| here)*(?=$|[.!?,])", "then come back"),
    (r"\b(?:and|then) (?:report|return|go|come) back(?: to me| here)?(?=$|[.!?,])", "then come back"),
    ((r"\b(?:go )?(?:and )?(?:have a (?:quick )?look|take a (?:quick )?look|peek|peep|pop|look in|nip|dash|hop) "
     r"(?=(?:in|into|at|round|over) )"), "go "),
    (r"\bgo (?:in|into|at|round|over) (?=(?:the|my) )", "go to "),
    (r"\bgo (?:and )?(?:check|inspect|check on|check out|see) (?=the [\w ]+?(?:$| and| then|,))", "go to "),
    (r"^(?:please )?check (?:on |out )?(?=the [\w ]+?(?:$| and| then|,))", "go to "),
    # conditions
    ((r"\b(?:in case|provided|given|assuming|supposing|suppose|on condition|as long as|so long as|only if|if and "
     r"only if"
     r"|if it (?:turns out|happens)|if it is (?:true|the case))(?: that| of)?\b(?= (?:there|the|it|a|you|i|any|"
     r"\w+ (?:is|are)))"),
     "if"),
    (r"\bin the event (?:that|of)\b", "if"),
    ((r"(^|[.,;] )(?:when|whenever|once) (?=(?:there (?:is|are)|the [\w ]+ (?:is|are) (?:in|on|at|open|closed|"
     r"there)|\w+ is in )"
     r"\b)"), r"\1if "),
    (r"^should (there|the [\w ]+?|\w+) be (.+?),", r"if \1 is \2,"),
    ((r"\bif you (?:happen to )?(?:see|find|come across|spot|notice|have|discover) (a|an|any|some|the) (.+?)"
     r"(?= (?:in|on|at)\b|,)"), r"if there is \1 \2"),
    (r"\bif there (?:is|are) (?:any|some|one|a few)(?: left)?(?=$|[.!?,])", ""),
    (r"\bgo to (the [\w ]+?) if (\w+|the [\w ]+?) is there\b", r"go to \1 if \2 is in \1"),
    ((r"[,;.]? (?:otherwise|or else|else|if not),? (?:do nothing|nothing|leave it(?: there| alone)?|do not bother"
     r"|do not do anything"
     r"|stay(?: where you are| here| put)?|forget it|just wait)(?=$|[.!])"), ""),
    (r"\b(is|are) (?:not )?(?:locked|shut)\b", r"\1 closed"),
    ((r"^(?:please )?(?:go (?:and )?)?(?:check|see|look|find out|tell me) (?:if|whether) (.+?)(?:[.,;?]| and)+ (?"
     r":and )?(?:if so|if yes"
     r"|if it is|if they are|if (?:he|she) is|then|in that case|if there (?:is|are))[,:]? "), r"if \1, "),
    ((r"^(?:please )?(?:go (?:and )?)?(?:check|see|look|find out|tell me) (?:if|whether) (.+?)(?:[.,;?]| and)+ (?"
     r":and )?(?:if not|otherwise"
     r"|if it is not|if there is none)[,:]? "), r"unless \1, "),
    (r"\bif there (?:is|are) (?:still |some |any |at least one )+", "if there is a "),
    (r"\bif (?:nobody|no one|no person|noone) is (?=(?:in|at)\b)", "if there is no person "),
    (r"\bif (?:anyone|anybody|someone|somebody) is (?=(?:in|at)\b)", "if there is a person "),
    (r"\bif not[,:]? then\b", "otherwise"),
    ((r"\b(?:but )?if (?:it|that|this|he|she) (?:is not|is not so|does not|are not)(?=,| (?:go|bring|put|take|"
     r"come))"), "otherwise"),
    ((r"\b(?:and )?if (?:there is not|there are not|there is none|none|nothing is there|it is not there|not so|"
     r"they are not)"
     r"(?: (?:any|one|there))?(?=,| (?:go|bring|put|take|come))"), "otherwise"),
    ((r"\? (?:if so|if yes|in that case|then|if it is|if there (?:is|are)|if that is so|when so)[,:]?"
     r" "), "? if so, "),
    (r"\bif not,? (?=(?:go|bring|put|take|come|get|drive|fetch|return|wait|pick)\b)", "otherwise "),
)  # fmt: skip
_MAX_CHARACTERS = 600
_COMPILED = tuple((re.compile(pattern), said) for pattern, said in _RULES)


def paraphrased(text: str) -> str:
    """``text`` in the words of the grammar, as far as the rules know."""
    if '"' in text or len(text) > _MAX_CHARACTERS:
        return text
    for pattern, said in _COMPILED:
        text = pattern.sub(said, text)
    text = _BACK.sub(r"\1 back where it was", text)
    return " ".join(text.split()) if "\n" not in text else text
