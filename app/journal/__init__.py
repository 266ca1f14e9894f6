"""The audit journal: tasks and all that was decided about them, on disk, so that nothing acknowledged is lost."""
