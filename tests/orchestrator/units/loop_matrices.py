"""An unsymmetric loop with direct feedthrough: z' = P z + Q u, y = R z + D u against u = E y.

The gain round the loop, D E, has a spectral radius of 7, so that passing values on diverges.
"""

import numpy as np

P = np.array([[-2.0, 5.0], [-1.0, -1.0]])
Q = np.array([[1.0, 0.0, 2.0], [0.0, -1.0, 0.5]])
R = np.array([[1.0, 2.0], [0.5, -1.0], [3.0, 0.0]])
D = np.array([[2.0, 1.0, 0.0], [0.0, -1.0, 3.0], [1.0, 0.0, 1.0]])
E = np.array([[3.0, 0.0, 1.0], [-1.0, 2.0, 0.0], [0.0, 1.0, -2.0]])
Z0 = np.array([1.0, -0.5])


def closed():
    """Rates of z with the loop closed, and y from z."""
    output = np.linalg.solve(np.eye(3) - D @ E, R)
    return P + Q @ E @ output, output
