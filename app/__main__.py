"""``python -m app`` is ``majordomo``."""

if __name__ == "__main__":  # and not again in the simulator's process, which begins by importing this
    from app.commands.main import main

    main()
