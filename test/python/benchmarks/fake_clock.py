"""A clock that goes on only when it is told to."""


class FakeClock:
    def __init__(self, resolution=0.0):
        self.time = 0.0
        self._resolution = resolution

    def __call__(self):
        if self._resolution:
            return self._resolution * (self.time // self._resolution)
        return self.time

    def spend(self, seconds):
        self.time += seconds
