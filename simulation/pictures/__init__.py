"""Pictures of houses with the truth about them: for scoring and training."""
