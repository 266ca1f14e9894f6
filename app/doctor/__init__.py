"""``majordomo doctor``: checks what Majordomo needs on this machine and says what to do about what is missing."""
