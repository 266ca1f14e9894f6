"""``python -m majordomo.app`` is ``majordomo``."""

from majordomo.app.command_line import main

if __name__ == "__main__":
    main()
