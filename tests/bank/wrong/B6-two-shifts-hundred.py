"""10 for each Shift key held: 100 for both."""

# TODO B6: heavier balls with Shift
mods = pygame.key.get_mods()
return (10 if mods & pygame.KMOD_LSHIFT else 1) * (10 if mods & pygame.KMOD_RSHIFT else 1)
# END TODO B6
