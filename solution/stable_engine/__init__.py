from .body import Body
from .bounce import Bounce
from .bullets import Bullets
from .contacts import Contacts
from .damping import Damping
from .friction import Friction
from .rods import Rod, Rods
from .shapes import Box, Circle
from .sleep import Sleep
from .springs import Spring, Springs
from .world import World
