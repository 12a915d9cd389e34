from mini_engine import main

if __name__ == "__main__":
    main()
