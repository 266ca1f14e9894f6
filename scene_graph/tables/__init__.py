"""The immutable tables behind a snapshot, copied on write."""
