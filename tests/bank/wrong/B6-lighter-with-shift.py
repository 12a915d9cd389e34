"""Makes the ball lighter, the wrong way round."""

# TODO B6: heavier balls with Shift
return 0.1 if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
# END TODO B6
