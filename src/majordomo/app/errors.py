"""Why a service does not start, or has no robot; light to import, so that the doctor can be asked what is wrong."""


class RobotUnavailable(RuntimeError):
    """There is no robot: it died, or a stored graph is served."""


class RefusedToBind(RuntimeError):
    """The address would be reachable from outside without protection, or cannot be had."""
