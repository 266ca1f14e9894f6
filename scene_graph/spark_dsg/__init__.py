"""The scene graph in the JSON of Spark-DSG, the format of MIT's Hydra and its relatives, and back."""
