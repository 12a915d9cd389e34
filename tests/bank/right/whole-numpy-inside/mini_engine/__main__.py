from .window import main

main()
