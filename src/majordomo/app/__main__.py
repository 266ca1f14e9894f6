"""``python -m majordomo.app`` is ``majordomo``."""

if __name__ == "__main__":  # and not again in the simulator's process, which begins by importing this
    from majordomo.app.command_line import main

    main()
