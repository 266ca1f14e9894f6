"""Verbs for what the robot cannot do. They are recognized so that they can be refused by name."""

from __future__ import annotations

UNABLE: tuple[str, ...] = (
    "open", "close", "shut", "lock", "unlock", "pour", "wash", "cook", "clean", "wipe", "vacuum", "sweep", "mop",
    "dust",
    "follow", "push", "pull", "press", "throw", "toss", "catch", "kick", "cut", "slice", "chop", "peel", "eat", "drink",
    "fill", "refill", "heat", "warm", "boil", "bake", "fry", "grill", "prepare", "make", "brew", "play", "sing",
    "dance",
    "call", "text", "email", "buy", "order", "purchase", "repair", "fix", "paint", "build", "assemble", "charge",
    "plug",
    "unplug", "feed", "water", "iron", "fold", "hang", "read", "write", "draw", "print", "guide", "lead", "escort",
    "accompany", "show", "teach", "watch", "guard", "wake", "measure", "weigh", "smell", "taste", "touch", "listen",
    "sort", "tidy", "tidy up", "organize", "organise", "arrange", "turn", "turn on", "turn off", "switch", "switch on",
    "switch off", "rotate", "spin", "flip", "shake", "stir", "mix", "squeeze", "break", "crush", "smash", "destroy",
    "hit",
    "attack", "kill", "hurt", "fly", "jump", "climb", "swim", "crawl", "scrub", "polish", "rinse", "dry", "hide",
    "explain", "tell", "inform", "notify", "warn", "announce",
    "translate", "remind", "schedule", "book", "record", "photograph", "film", "scan", "unpack", "pack", "wrap",
    "unwrap",
    "load", "unload", "empty", "drain", "light", "ignite", "burn", "dial", "answer", "speak", "talk", "whisper",
    "shout",
    "greet", "hug", "kiss", "massage", "dress", "undress", "shave", "brush", "comb", "tie", "untie", "knock", "ring",
    "hammer", "drill", "screw", "saw", "glue", "tape", "sew", "knit", "wear", "download", "install", "reboot", "delete",
    "remove", "insert", "attach", "detach", "swap", "exchange", "compare", "push aside", "stack", "pile", "spread",
    "share",
    "divide", "steal", "sell", "pay", "babysit", "nurse", "heal", "inject", "bathe", "shower", "flush", "trim", "mow",
    "plant", "dig", "rake", "shovel", "ride", "steer", "park", "tow", "race", "chase", "search the internet", "google",
    "take out", "take a picture of", "take a photo of", "take off", "slide", "drag", "roll up", "unroll", "blow",
    "whistle",
    "guess", "calculate", "add", "subtract", "multiply", "pretend", "ignore", "forget", "obey", "disregard",
)  # fmt: skip
"""Verbs that need hands, senses or rights that the robot lacks; refused by name."""
