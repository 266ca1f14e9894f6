"""The Controller: watches, while a step is carried out, whether what the plan counts on still holds."""
