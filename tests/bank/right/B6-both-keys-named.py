"""Another way: both keys named."""

# TODO B6: heavier balls with Shift
held = pygame.key.get_mods() & (pygame.KMOD_LSHIFT | pygame.KMOD_RSHIFT)
return 10 ** bool(held)
# END TODO B6
